#pragma once
/// The study: every contender with every number of particles on every recording, seeds paired, times interleaved.

#include <atomic>
#include <functional>
#include <memory>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/compare/contender.hpp"
#include "mote/engine/run_record.hpp"

namespace mote::compare {

/// What errors are measured of: one state, or the position of a model with states x and y.
struct Target {
  std::string name, unit;
  std::vector<std::size_t> states;
};

/// The target of that name; the default is the position, or else the first state.
///
/// error   Refusal (kWrongUse) with the names there are
Target target_of(const std::string& name, const std::vector<Quantity>& states, const std::string& where);

/// Errors of one run along its recording.
struct Measured {
  std::uint64_t seed = 0;
  std::size_t recording = 0;
  double mse_truth = 0;      ///< mean over the steps of |estimated mean - truth|^2 of the target; NaN without truth
  double mse_reference = 0;  ///< the same to the reference's mean; NaN without reference
  double nees = 0;           ///< sum over the steps of e' P^-1 e, e = mean - truth of all known states
  double nees_dof = 0;       ///< the degrees of freedom of that sum: independent directions of P
  double judged_steps = 0;   ///< steps with a truth
  double covered_steps = 0;  ///< of these, those whose e' P^-1 e is inside the 95 % region of a Gaussian
  double final_error = 0;    ///< distance of the target at the last step with a truth
  double log_evidence = 0;   ///< nat; -infinity after a collapse
  double seconds = 0;        ///< in stepping and estimating; NaN after a collapse
  double ns_per_particle_step = 0;
  double messages_per_step = 0,
         bytes_per_step = 0;  ///< between the groups of a distributed filter; NaN after a collapse
  bool collapsed = false;     ///< at some step all weights were zero; a run that ended there has infinite errors
};

/// Posterior means by recording that errors are measured against.
struct Reference {
  std::string name;    ///< "grid filter (exact)", "sisr -n 200000"; empty: none
  bool exact = false;  ///< else a run whose own Monte-Carlo error is in every MSE
  std::vector<referee::Solution> solutions;
};

/// What is compared.
struct Design {
  std::string model, where;
  std::shared_ptr<const CatalogueModel> catalogue_model;
  std::vector<Scene> scenes;  ///< a truth that is not known has no states
  std::vector<Contender> contenders;
  std::vector<std::size_t> particles;
  std::size_t repeats = 1;
  std::uint64_t seed = 1;
  Target target;
  Reference reference;

  /// Runs of one contender with one N: recordings x repeats.
  std::size_t runs() const { return scenes.size() * repeats; }
  /// The filter's seed of repeat r on recording k: seed + k R + r, the same for every contender and N.
  std::uint64_t seed_of(std::size_t recording, std::size_t repeat) const { return seed + recording * repeats + repeat; }
  bool has_truth() const { return !scenes.front().truth.states.empty(); }
};

/// Normalised estimation error squared of one step: e' P^-1 e with the particles' covariance P, angles wrapped.
struct Nees {
  double value, degrees_of_freedom;
};

/// NEES of a weighted set against the true state, over the states with a known value.
///
///   e = mean - truth,  P = sum W (x - mean)(x - mean)';  directions in which P vanishes (correlations below 1e-9) are
///   left out; a state of no spread that is wrong gives infinity
///
/// shape   truth: (D,), NaN where not known
/// cost    O(N D^2 + D^3)
/// source  Bar-Shalom, Li & Kirubarajan 2001, sec. 5.4
Nees normalised_error(const WeightedSet& set, const std::vector<Quantity>& states, std::span<const double> truth);

/// Told of the work done and of all there is: particles in all runs, or recordings of a reference.
using ProgressOf = std::function<void(std::size_t done, std::size_t all)>;

/// Solves the recordings exactly by the model's solver.
///
/// error   Refusal: kInterrupted; an empty reference where no solver is known or it does not reach
Reference exact_reference(const Design& design, const ProgressOf& progress, const std::atomic<bool>& stop);

/// Runs the plan once on each recording, its seed one past the contenders' seeds.
///
/// error   Refusal: kCollapsed, kInterrupted
Reference run_reference(const Design& design, const Plan& plan, const std::string& name, const ProgressOf& progress,
                        const std::atomic<bool>& stop);

/// Fills in a run's errors and times from its record; run.recording says on which recording it was.
void measure(const Design& design, const RunRecord& record, Measured& run);

/// Runs everything: recordings, repeats, particles, contenders, the last innermost and in turns first.
///
/// shape   (contenders, numbers of particles, K R), run (k, r) at k R + r
/// error   Refusal: what a contender's run refuses, kInterrupted
std::vector<std::vector<std::vector<Measured>>> run_study(const Design& design, const ProgressOf& progress,
                                                          const std::atomic<bool>& stop);

/// Refuses contenders that the model, the engine or the memory cannot serve, before the work.
void check_contenders(const Design& design);

}  // namespace mote::compare

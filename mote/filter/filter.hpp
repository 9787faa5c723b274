#pragma once
/// What every filter does with a step, whatever its model and number type.

#include <cmath>

#include "mote/base/archive.hpp"
#include "mote/filter/estimate.hpp"
#include "mote/filter/traffic.hpp"
#include "mote/model/model.hpp"

namespace mote {

/// What happened in one step.
struct StepReport {
  double log_evidence = 0;   ///< log p(y_t | y_{1:t-1}), nat; 0 without an observation, -infinity on collapse
  double ess = 0;            ///< effective sample size before selection
  double acceptance = kNaN;  ///< accepted / offered of the Metropolis chains
  std::size_t burn_in = 0;   ///< N_b that the chains used
  bool selected = false;     ///< resampled, or a chain ran
  bool collapsed = false;    ///< all weights were zero
  Traffic traffic = {};      ///< what the groups of a distributed filter sent each other
};

/// A particle filter in motion. A step is update() – move and weigh –, then estimates from weighted(), then select().
///
///   filter.update(t, rows, report);  ... estimates from filter.weighted() ...;  filter.select(t, report);
///
/// A step without an observation is predict(t) alone. Steps are visited in increasing order, none left out.
class Filter {
 public:
  virtual ~Filter() = default;

  /// Moves every particle once by the model; weights stay.
  virtual StepReport predict(Step t) = 0;
  /// Proposes particles for step t and weighs them by the rows observed there (at least one value seen).
  virtual StepReport update(Step t, Rows<double> rows) = 0;
  /// Resamples, or runs the chain: makes the set that the next step starts from.
  virtual void select(Step t, StepReport& report) = 0;
  /// The weighted particles after predict() or update(), until select().
  virtual WeightedSet weighted() const = 0;
  /// Writes or reads everything that the next step depends on, between steps: after select(), or after predict() where
  /// nothing was observed. A filter of the same construction that has read goes on bit by bit as the one that wrote.
  ///
  /// error   ArchiveMismatch when what is read was written by a filter of another size
  virtual void keep(Archive& archive) = 0;
  /// Mean and standard deviation of component d of that set; circular ones for an angle.
  virtual Moments moments(std::size_t d, bool angle) const { return component_moments(weighted(), d, angle); }

 protected:
  Filter() = default;
  Filter(const Filter&) = default;
  Filter(Filter&&) = default;
  Filter& operator=(const Filter&) = default;
  Filter& operator=(Filter&&) = default;
};

}  // namespace mote

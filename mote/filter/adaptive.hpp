#pragma once
/// Adaptive number of particles: as many as the last steps' weights ask for, as few as the time allows.

#include <cstdint>
#include <memory>
#include <vector>

#include "mote/filter/elastic.hpp"
#include "mote/filter/filter.hpp"

namespace mote {

constexpr std::size_t kWholeLanes = 64;  ///< numbers that are chosen are multiples of it: the lanes of any vector

/// What decides on the number of particles of a step.
struct AdaptiveOptions {
  std::size_t least = 64, most = 1000;  ///< N is between them; the first step has the most
  /// Wanted standard error of a mean by Monte Carlo, in standard deviations of what is estimated: so 1 / error^2
  /// particles of equal weight. 0: the most, always.
  double error = 0.005;
  /// Widths of bins by component, in its unit; 0: a component that is not divided. Empty: bins are not counted.
  std::vector<double> bins = {};
  double divergence = 0.05;  ///< wanted Kullback-Leibler distance to the law over the bins
  double surpassed = 0.01;   ///< probability that it is further
};

/// Particles with which the sampled law over k bins is within `divergence` of the true one, but for a probability of
/// `surpassed`; 1 for a single bin.
///
///   N = (k - 1) / (2 divergence) (1 - 2 / (9 (k - 1)) + sqrt(2 / (9 (k - 1))) z)^3,   z the normal quantile of 1 -
///   surpassed
///
/// source  Fox 2003, (7): a chi-square quantile by Wilson & Hilferty
double particles_for_bins(std::size_t bins, double divergence, double surpassed);

/// Bins in which particles weigh at least as much as one of N: those where a selection leaves one, in the mean.
///
/// cost    O(N) time and memory
std::size_t occupied_bins(const WeightedSet& set, const std::vector<double>& widths);

/// Independent states that a state of a Metropolis chain is worth:  a / (2 - a).
///
/// source  the correlation of neighbours is 1 - a where all proposals are accepted with the same probability a
inline double worth_of_acceptance(double a) { return a / (2 - a); }

/// Numbers that a run had.
struct ParticleCounts {
  std::size_t steps = 0;            ///< of the sum
  std::size_t least = 0, most = 0;  ///< of the steps with an observation
  double sum = 0;                   ///< over all steps

  double mean() const { return steps == 0 ? kNaN : sum / static_cast<double>(steps); }
  void add(std::size_t particles, bool observed);
};

/// A filter whose N follows its weights.
///
///   r = N / ESS of the last step, or its mean over about sixteen if that is larger
///   N = max( r, (2 - a) / a ) / error^2,   a the acceptance of its chains,   at least what the bins ask for,
///   rounded up to 64, between `least` and `most`; `most` after a collapse
///
/// It depends on nothing else: a run of the same seed, `least` and `most` has the same numbers. What is learned from a
/// step holds from the next one on. SISR changes N where it selects, chains change both N and Q.
///
/// shape   the filter has `most` particles and is Elastic; chains have Q = N, and `least` is at least their number
/// error   std::invalid_argument for a filter that is not Elastic
/// cost    none, but for bins: O(N) a step
/// source  docs/filters.md (F45) to (F48); Fox 2003 on the bins; Kong, Liu & Wong 1994 on ESS
class AdaptiveFilter final : public Filter {
 public:
  AdaptiveFilter(std::unique_ptr<Filter> filter, AdaptiveOptions options);

  StepReport predict(Step t) override;
  StepReport update(Step t, Rows<double> rows) override;
  void select(Step t, StepReport& report) override;
  WeightedSet weighted() const override { return filter_->weighted(); }
  Moments moments(std::size_t d, bool angle) const override { return filter_->moments(d, angle); }
  /// error   std::logic_error: a run whose numbers change is not kept
  void keep(Archive& archive) override;

  const ParticleCounts& counts() const { return counts_; }
  /// Particles, or proposals, that the last step weighed; to be asked before select().
  std::size_t weighed() const { return elastic_->weighed(); }

 private:
  void note(const StepReport& report);
  std::size_t wanted(const StepReport& report) const;

  std::unique_ptr<Filter> filter_;
  Elastic* elastic_;
  AdaptiveOptions options_;
  ParticleCounts counts_;
  double ratio_ = 0, mean_ratio_ = 0;  // N / ESS; 0: not known
  double acceptance_ = kNaN;
  double for_bins_ = 0;
};

}  // namespace mote

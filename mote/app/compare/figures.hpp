#pragma once
/// The figures of a comparison: one row for each contender and number of particles.

#include <optional>

#include "mote/app/compare/statistics.hpp"
#include "mote/app/compare/study.hpp"

namespace mote::compare {

/// A number with its 95 % interval.
struct Estimate {
  double value;
  Interval interval;
};

/// What the runs of one contender with one N say. MSE is to the reference where there is one, else to the truth.
struct Figures {
  double rmse_truth;                ///< root of the mean over runs of the MSE to the truth; NaN without truth
  Estimate median_mse, mean_mse;    ///< over runs, by the bootstrap
  std::optional<Estimate> ratio;    ///< of the median MSE to the first contender's at the same N, paired; not of itself
  double nees;                      ///< sum of NEES / sum of its degrees of freedom, 1 = calibrated; NaN without truth
  Interval nees_band;               ///< where it lies 95 times of 100 with Gaussian errors independent between steps
  double coverage;                  ///< share of steps inside the 95 % region; NaN without truth
  std::size_t collapsed;            ///< runs
  std::optional<std::size_t> lost;  ///< runs that collapsed or end further from the truth than the bound
  double log_evidence, log_evidence_sd;      ///< mean over runs; deviation over repeats, pooled over recordings
  double seconds, ns_per_particle_step;      ///< medians over the runs that did not collapse
  double messages_per_step, bytes_per_step;  ///< likewise
};

/// Sums a study up.
///
/// `lost_beyond`: the bound on the distance at the last step with a truth; empty: tracks are not judged
///
/// shape   runs: (contenders, numbers of particles, K R) as run_study() gives them; out: (contenders, numbers)
std::vector<std::vector<Figures>> figures_of(const Design& design,
                                             const std::vector<std::vector<std::vector<Measured>>>& runs,
                                             std::optional<double> lost_beyond);

}  // namespace mote::compare

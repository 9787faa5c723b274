#pragma once
/// What comparisons compute from the repeats of runs.

#include <optional>
#include <vector>

#include "mote/app/compare/statistics.hpp"
#include "mote/app/reproduce/item.hpp"
#include "mote/engine/recording.hpp"
#include "mote/engine/run_record.hpp"

namespace mote::reproduce {

/// What a comparison takes from its repeats: a few numbers of each, by run.
///
/// shape   values: (runs, R, n); sds: (R, n), the posterior deviations of the second run, for kMeanDifference
///         n = T steps for kMeanDifference and kMeanSpread, the runs of a series for kParticlesEnough, else 1;
///         particles: (runs, n) for kParticlesEnough, rising
struct Samples {
  std::vector<std::vector<std::vector<double>>> values;
  std::vector<std::vector<double>> sds;
  std::vector<std::vector<double>> particles = {};

  std::size_t repeats() const { return values.front().size(); }
};

/// RMSE over time of the bearing, from the origin, of the mean position: the part of a track that bearings tell.
///
/// shape   x, y: places of the two states; NaN without a truth
double bearing_rmse(const RunRecord& run, const Truth& truth, std::size_t x, std::size_t y);

/// The number that a comparison asks for.
///
///   mean-difference   sqrt(mean_t (a_t - b_t)^2) / unit,   a_t, b_t: means over repeats
///                     unit: sqrt(mean_t (var a_t + var b_t) / R), or each difference by its posterior sd, or 1
///   mean-spread       sqrt(mean_t var a_t)
///   particles-enough  min {N_i: mean a_j <= (1 + slack) mean a_n for all j >= i},   a_j: errors with N_j particles
///   recovered         (a - b) / (a - c),   a, b, c: mean or median of the three runs' errors
///   evidence-spread   sqrt(var a);   normalised-error   sqrt(mean a), a: mean squares;   the others: mean or median of
///   a
///
/// With two runs, all but the mean difference are the first's over the second's.
/// error   none; NaN where a value is
double statistic(const Comparison& comparison, const Samples& samples);

/// Its standard error over the repeats, by leaving out one repeat at a time (jackknife); nothing for medians, for
/// numbers of particles and for a mean difference in standard errors, which judges itself.
std::optional<double> standard_error(const Comparison& comparison, const Samples& samples);

/// Where a median, or what is formed of medians, lies 95 times of 100: by the bootstrap over the repeats, the runs
/// paired; nothing for what has a standard error, and where a resampled number does not exist.
std::optional<compare::Interval> interval(const Comparison& comparison, const Samples& samples);

}  // namespace mote::reproduce

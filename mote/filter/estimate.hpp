#pragma once
/// Estimate: moments, quantiles and probabilities from weighted particles.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "mote/filter/particles.hpp"

namespace mote {

/// Mean and standard deviation of a scalar.
struct Moments {
  double mean, sd;
};

/// Weighted mean and standard deviation; for an angle the circular ones.
///
///   mean = sum W x,  sd = sqrt(sum W (x - mean)^2)
///   angle: C = sum W cos x,  S = sum W sin x,  mean = atan2(S, C),  sd = sqrt(-2 log |(C, S)|)
///
/// shape   values, weights: (N,), weights >= 0 with a positive sum
/// unit    that of the values (rad for an angle)
/// cost    O(N), two passes
/// source  docs/filters.md (F28), (F29); Mardia & Jupp 2000, sec. 2.3 for the circular ones
template <class R>
Moments moments(std::span<const R> values, std::span<const double> weights, double total, bool angle);

/// The same from mean_of(f), the weighted mean of a function of the value.
template <class MeanOf>
Moments moments_by(const MeanOf& mean_of, bool angle) {
  if (angle) {
    const double c = mean_of([](double v) { return std::cos(v); });
    const double s = mean_of([](double v) { return std::sin(v); });
    return {std::atan2(s, c), std::sqrt(std::max(0.0, -2 * std::log(std::min(1.0, std::hypot(c, s)))))};
  }
  const double mean = mean_of([](double v) { return v; });
  return {mean, std::sqrt(mean_of([&](double v) { return (v - mean) * (v - mean); }))};
}

/// The smallest value whose cumulative weight reaches `level` of the total. An angle is unrolled about its circular
/// mean.
///
/// shape   0 <= level <= 1
/// cost    O(N log N)
/// source  docs/filters.md (F30)
double quantile(std::span<const double> values, std::span<const double> weights, double level, bool angle);

/// The weight share of the values above (or below) a threshold.
double probability(std::span<const double> values, std::span<const double> weights, double threshold, bool above);

/// Moments of component d of a set.
Moments component_moments(const WeightedSet& set, std::size_t d, bool angle);

}  // namespace mote

#include "mote/filter/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mote/base/log_weights.hpp"

namespace mote {

template <class R>
Moments moments(std::span<const R> values, std::span<const double> weights, double total, bool angle) {
  const auto mean_of = [&](auto&& f) {
    return ordered_sum(
               values.size(),
               [&](std::size_t i) { return weights[i] > 0 ? weights[i] * f(static_cast<double>(values[i])) : 0.0; }) /
           total;
  };
  return moments_by(mean_of, angle);
}

template Moments moments(std::span<const double>, std::span<const double>, double, bool);
template Moments moments(std::span<const float>, std::span<const double>, double, bool);

double quantile(std::span<const double> values, std::span<const double> weights, double level, bool angle) {
  std::vector<double> unrolled(values.begin(), values.end());
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (angle) {
    const double centre = moments(values, weights, total, true).mean;
    for (double& v : unrolled) v = centre + numbers::wrap(v - centre);
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return unrolled[a] < unrolled[b]; });
  double through = 0;
  for (const std::size_t i : order) {
    through += weights[i];
    // the last one reaches any level, whatever the sums' rounding
    if (through >= level * total || i == order.back()) return angle ? numbers::wrap(unrolled[i]) : unrolled[i];
  }
  return kNaN;
}

double probability(std::span<const double> values, std::span<const double> weights, double threshold, bool above) {
  double inside = 0;
  double total = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    total += weights[i];
    if (above ? values[i] > threshold : values[i] < threshold) inside += weights[i];
  }
  return inside / total;
}

Moments component_moments(const WeightedSet& set, std::size_t d, bool angle) {
  return set.visit([&](const auto& x) { return moments(x.component(d), set.weights, set.total, angle); });
}

}  // namespace mote

#include "mote/base/log_weights.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote {

LogSum log_sum_exp(std::span<const double> log_weights) {
  double largest = -kInfinity;
  for (const double l : log_weights) largest = std::max(largest, l);
  if (!std::isfinite(largest)) return {largest, largest};
  const double sum = ordered_sum(log_weights.size(), [&](std::size_t i) { return std::exp(log_weights[i] - largest); });
  return {largest, largest + std::log(sum)};
}

double exponentiate(std::span<const double> log_weights, double largest, std::span<double> weights) {
  return ordered_sum(log_weights.size(),
                     [&](std::size_t i) { return weights[i] = std::exp(log_weights[i] - largest); });
}

double effective_sample_size(std::span<const double> weights) {
  const double sum = ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; });
  const double squares = ordered_sum(weights.size(), [&](std::size_t i) { return weights[i] * weights[i]; });
  return squares > 0 ? std::min(sum * sum / squares, static_cast<double>(weights.size())) : 0;
}

}  // namespace mote

#include "mote/hardware/filters/estimate.hpp"

#include <cmath>

namespace mote::hardware {

double log2_evidence(const Estimate& estimate, const Formats& formats, std::uint64_t proposals) {
  return std::log2(static_cast<double>(estimate.sum)) - formats.weight_bits +
         static_cast<double>(kQuantum) * static_cast<double>(estimate.scale) -
         std::log2(static_cast<double>(proposals));
}

std::uint64_t sum_of(std::span<const ScaledWeight> weights) {
  std::uint64_t sum = 0;
  for (const ScaledWeight& w : weights) sum = (sum >> (kQuantum * w.rise)) + w.weight;
  return sum;
}

std::vector<std::int64_t> weighted_means(std::span<const std::vector<std::int64_t>> states,
                                         std::span<const ScaledWeight> weights, std::uint64_t divisor, unsigned extra) {
  __extension__ using Wide = __int128;
  std::vector<std::int64_t> means;
  means.reserve(states.size());
  for (const auto& column : states) {
    std::int64_t total = 0;
    for (std::size_t j = 0; j < weights.size(); ++j)
      total = (total >> (kQuantum * weights[j].rise)) + column[j] * static_cast<std::int64_t>(weights[j].weight);
    means.push_back(static_cast<std::int64_t>(Wide{total} * (Wide{1} << extra) / static_cast<Wide>(divisor)));
  }
  return means;
}

}  // namespace mote::hardware

#include "mote/hardware/filters/estimate.hpp"

#include <algorithm>
#include <cmath>

namespace mote::hardware {

double log2_evidence(const Estimate& estimate, const Formats& formats, std::uint64_t proposals) {
  return std::log2(static_cast<double>(estimate.sum)) - formats.weight_bits +
         static_cast<double>(kQuantum) * static_cast<double>(estimate.scale) -
         std::log2(static_cast<double>(proposals));
}

std::uint64_t sum_of(std::span<const ScaledWeight> weights) {
  std::uint64_t sum = 0;
  for (const ScaledWeight& w : weights) sum = lowered(sum, w.rise) + w.weight;
  return sum;
}

std::vector<std::int64_t> weighted_means(std::span<const std::vector<std::int64_t>> states,
                                         std::span<const ScaledWeight> weights, std::uint64_t divisor,
                                         const Formats& formats) {
  __extension__ using Wide = __int128;
  const unsigned dropped = formats.value_bits - 1;
  const std::int64_t half = std::int64_t{1} << (dropped - 1);
  std::vector<std::int64_t> means;
  means.reserve(states.size());
  for (const auto& column : states) {
    std::int64_t total = 0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const std::int64_t product = column[j] * static_cast<std::int64_t>(weights[j].weight);
      total = lowered(total, weights[j].rise) + ((product + half) >> dropped);
    }
    const Wide numerator = Wide{total} * (Wide{1} << (dropped + formats.extra_bits));
    const Wide cut = numerator / static_cast<Wide>(divisor);
    means.push_back(static_cast<std::int64_t>(cut - (cut * static_cast<Wide>(divisor) > numerator ? 1 : 0)));
  }
  return means;
}

}  // namespace mote::hardware

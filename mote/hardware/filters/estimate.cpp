#include "mote/hardware/filters/estimate.hpp"

#include <cmath>

namespace mote::hardware {

double log2_evidence(const Estimate& estimate, const Formats& formats, std::uint64_t proposals) {
  return std::log2(static_cast<double>(estimate.sum)) - formats.weight_bits +
         static_cast<double>(kQuantum) * static_cast<double>(estimate.scale) -
         std::log2(static_cast<double>(proposals));
}

std::vector<std::int64_t> ValueSums::divided(std::uint64_t divisor, unsigned extra) const {
  __extension__ using Wide = __int128;
  std::vector<std::int64_t> quotients;
  quotients.reserve(totals_.size());
  for (const std::int64_t total : totals_)
    quotients.push_back(static_cast<std::int64_t>(Wide{total} * (Wide{1} << extra) / static_cast<Wide>(divisor)));
  return quotients;
}

}  // namespace mote::hardware

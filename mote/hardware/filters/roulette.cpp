#include "mote/hardware/filters/roulette.hpp"

#include <algorithm>

namespace mote::hardware {
namespace {

/// Sums of the weights up to each as they were taken, all but the last, at the last one's scale.
std::vector<std::uint64_t> sums_below_last(std::span<const ScaledWeight> weights) {
  std::vector<std::uint64_t> sums;
  std::uint64_t sum = 0;
  for (const ScaledWeight& w : weights.first(weights.size() - 1)) {
    sum = lowered(sum, w.rise) + w.weight;
    sums.push_back(lowered(sum, quanta_between(w.scale, weights.back().scale)));
  }
  return sums;
}

/// Cycles from writing the last weight to the first parent, beside the levels' and the product's.
constexpr std::uint64_t kBesideLevels = 6;
constexpr std::uint64_t kLevel = 4;

}  // namespace

RouletteWalk::RouletteWalk(const Weighed& weighed, unsigned count_bits, Words& words, unsigned product_latency)
    : now_(weighed.written.back() + 1),
      first_(weighed.written.back() + kBesideLevels + product_latency + kLevel * count_bits) {
  __extension__ using Wide = unsigned __int128;
  const std::vector<std::uint64_t> sums = sums_below_last(weighed.weights);
  for (std::size_t j = 0; j < weighed.weights.size(); ++j) {
    const auto threshold = static_cast<std::uint64_t>((Wide{weighed.total} * (words.next() >> 8)) >> 24);
    parents_.push_back(
        static_cast<std::uint32_t>(std::upper_bound(sums.begin(), sums.end(), threshold) - sums.begin()));
  }
}

bool RouletteWalk::cycle(bool ready, std::vector<std::uint32_t>& parents) {
  const bool taken = ready && shows();
  if (taken) parents.push_back(parents_[taken_++]);
  ++now_;
  return taken;
}

}  // namespace mote::hardware

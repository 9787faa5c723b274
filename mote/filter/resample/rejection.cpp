#include <algorithm>

#include "mote/base/scan.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {
namespace {

constexpr int kMostTries = 4096;  // beyond it a cumulative sum is cheaper than more candidates

}  // namespace

// Murray, Lee & Jacob 2016, alg. 3: child j tries particle j, then uniform candidates, each accepted with w / w_max.
// Unbiased. A child without success after 4096 candidates is drawn by inversion of the cumulative sum: the same law.
void rejection(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const std::size_t n = weights.size();
  const double largest = *std::max_element(weights.begin(), weights.end());
  const WeightScan scan(weights);
  const std::size_t whole_passes =
      ancestors.size() / n * n;  // children that may start at their own place without favouring any
  draws.for_each(Purpose::kSelect, 0, ancestors.size(), [&](std::size_t j, auto& draw) {
    std::size_t candidate = j < whole_passes ? j % n : draw.index(n);
    int tries = 0;
    while (draw.uniform() * largest > weights[candidate] && ++tries < kMostTries) candidate = draw.index(n);
    if (tries == kMostTries) candidate = scan.find(draw.uniform() * scan.total());
    ancestors[j] = static_cast<std::uint32_t>(candidate);
  });
}

}  // namespace mote

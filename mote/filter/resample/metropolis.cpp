#include <algorithm>
#include <cmath>

#include "mote/base/log_weights.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {
namespace {

constexpr double kBias = 1e-4;          // total variation left after the chain
constexpr double kLongestChain = 4096;  // beyond it a cumulative sum is cheaper than the chains

}  // namespace

// Murray, Lee & Jacob 2016, alg. 2: child j starts at particle j (children beyond whole passes at a uniform one) and
// makes B Metropolis moves among all particles. B = log(bias) / log(1 - mean/largest), their (5), so that a chain is
// within `bias` of its law in total variation. Where the weights are so uneven that B passes 4096, the children are
// drawn by roulette.
void metropolis(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const std::size_t n = weights.size();
  const double largest = *std::max_element(weights.begin(), weights.end());
  const double mean = ordered_sum(n, [&](std::size_t i) { return weights[i]; }) / static_cast<double>(n);
  const double moves = mean < largest ? std::ceil(std::log(kBias) / std::log1p(-mean / largest)) : 0;
  if (moves > kLongestChain) return roulette(weights, draws, ancestors);
  const std::size_t whole_passes =
      ancestors.size() / n * n;  // children that may start at their own place without favouring any
  draws.for_each(Purpose::kSelect, 0, ancestors.size(), [&](std::size_t j, auto& draw) {
    std::size_t at = j < whole_passes ? j % n : draw.index(n);
    // after the B moves go on while the chain still sits on a weight of zero
    for (double b = 0; b < moves || weights[at] <= 0; ++b) {
      const double u = draw.uniform();
      const std::size_t candidate = draw.index(n);
      if (u * weights[at] <= weights[candidate]) at = candidate;
    }
    ancestors[j] = static_cast<std::uint32_t>(at);
  });
}

}  // namespace mote

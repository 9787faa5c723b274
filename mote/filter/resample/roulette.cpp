#include "mote/base/scan.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {

// FPGA, section II: draw r, accumulate the weights until their sum passes r. Block sums make it O(log N) instead of
// O(N).
void roulette(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const WeightScan scan(weights);
  draws.for_each(Purpose::kSelect, 0, ancestors.size(), [&](std::size_t j, auto& draw) {
    ancestors[j] = static_cast<std::uint32_t>(scan.find(draw.uniform() * scan.total()));
  });
}

}  // namespace mote

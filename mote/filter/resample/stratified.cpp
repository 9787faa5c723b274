#include "mote/base/scan.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {

// Kitagawa 1996: u_j = (j + U_j) / N_out with independent U_j ~ U(0, 1).
void stratified(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const WeightScan scan(weights);
  const double step = scan.total() / static_cast<double>(ancestors.size());
  WeightScan::Walk walk(scan);
  draws.for_each(Purpose::kSelect, 0, ancestors.size(), [&](std::size_t j, auto& draw) {
    ancestors[j] = static_cast<std::uint32_t>(walk.find((static_cast<double>(j) + draw.uniform()) * step));
  });
}

}  // namespace mote

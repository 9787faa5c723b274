#include "mote/base/scan.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {

// PPF Alg. 5: u_j = (j + u) / N_out with one u ~ U(0, 1), then a walk along the cumulative sum.
void systematic(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const WeightScan scan(weights);
  const double step = scan.total() / static_cast<double>(ancestors.size());
  const double u = draws.uniform(Purpose::kSelect);
  WeightScan::Walk walk(scan);
  for (std::size_t j = 0; j < ancestors.size(); ++j)
    ancestors[j] = static_cast<std::uint32_t>(walk.find((static_cast<double>(j) + u) * step));
}

}  // namespace mote

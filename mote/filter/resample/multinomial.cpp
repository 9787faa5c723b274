#include <cmath>

#include "mote/base/log_weights.hpp"
#include "mote/base/scan.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {

// Ordered uniforms without sorting: partial sums of N_out + 1 exponentials over their total are uniform order
// statistics (Devroye 1986, V.3). The exponentials are drawn twice from their addresses instead of being stored.
void multinomial(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const WeightScan scan(weights);
  double whole = 0;
  draws.for_each(Purpose::kSelect, 0, ancestors.size() + 1,
                 [&](std::size_t, auto& draw) { whole -= std::log(draw.uniform()); });
  double part = 0;
  WeightScan::Walk walk(scan);
  draws.for_each(Purpose::kSelect, 0, ancestors.size(), [&](std::size_t j, auto& draw) {
    part -= std::log(draw.uniform());
    ancestors[j] = static_cast<std::uint32_t>(walk.find(part / whole * scan.total()));
  });
}

}  // namespace mote

#include <algorithm>
#include <cmath>
#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {
namespace {

constexpr double kRounding =
    1e-12;  // relative: so far below a whole number an expected count is that number, spoilt by the sum

}  // namespace

// Liu & Chen 1998: floor(N_out w_i) certain copies; the R that are left are multinomial in the remainders, whose sum is
// R.
void residual(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const double total = ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; });
  const double scale = static_cast<double>(ancestors.size()) / total;
  std::vector<double> remainders(weights.size());
  std::size_t placed = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = weights[i] * scale;
    const double certain = std::floor(expected * (1 + kRounding));
    remainders[i] = std::max(0.0, expected - certain);
    for (double k = 0; k < certain && placed < ancestors.size(); ++k)
      ancestors[placed++] = static_cast<std::uint32_t>(i);
  }
  if (placed < ancestors.size()) multinomial(remainders, draws, ancestors.subspan(placed));
}

}  // namespace mote

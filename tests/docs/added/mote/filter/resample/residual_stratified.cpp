#include <cmath>
#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {

// floor(N_out w_i) certain copies; the rest stratified in the remainders instead of multinomial: less variance than
// residual at the same cost.
void residual_stratified(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const double total = ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; });
  const double scale = static_cast<double>(ancestors.size()) / total;
  std::vector<double> remainders(weights.size());
  std::size_t placed = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = weights[i] * scale;
    const double certain = std::floor(expected);
    remainders[i] = expected - certain;
    for (double k = 0; k < certain && placed < ancestors.size(); ++k)
      ancestors[placed++] = static_cast<std::uint32_t>(i);
  }
  if (placed < ancestors.size()) stratified(remainders, draws, ancestors.subspan(placed));
}

}  // namespace mote

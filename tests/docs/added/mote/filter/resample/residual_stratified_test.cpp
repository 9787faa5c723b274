#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mote/filter/resample/schemes.hpp"

namespace mote {

void residual_stratified(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);

namespace {

/// The largest |z| over the particles of the claim that particle i has N w_i children in the mean.
double worst_z(ResampleFunction scheme, const std::vector<double>& weights, const std::vector<double>& claimed) {
  constexpr int kRounds = 4000;
  const std::size_t n = weights.size();
  std::vector<double> sum(n), squares(n);
  for (std::uint32_t round = 1; round <= kRounds; ++round) {
    std::vector<std::uint32_t> ancestors(n);
    scheme(weights, Draws{round, 1}, ancestors);
    std::vector<double> count(n);
    for (const auto a : ancestors) count[a] += 1;
    for (std::size_t i = 0; i < n; ++i) {
      sum[i] += count[i];
      squares[i] += count[i] * count[i];
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double mean = sum[i] / kRounds;
    const double variance = squares[i] / kRounds - mean * mean;
    const double off = mean - static_cast<double>(n) * claimed[i];
    if (std::abs(off) > 1e-9) worst = std::max(worst, std::abs(off) / std::sqrt(variance / kRounds + 1e-12));
  }
  return worst;
}

// claim    particle i has N w_i children in the mean, one of weight zero has none
// referee  the weights
// design   4000 resamplings of five particles, seeds 1..4000
// risk     2.5e-6 in all (|z| < 5.03 for each of five); the twin, weights shifted by 0.02, must be caught
TEST(ResidualStratified, HasTheRightMeanNumbersOfChildren) {
  const std::vector<double> weights{0.45, 0.0, 0.25, 0.23, 0.07};
  EXPECT_LT(worst_z(residual_stratified, weights, weights), 5.03);
  EXPECT_GT(worst_z(residual_stratified, weights, {0.43, 0.0, 0.27, 0.23, 0.07}), 5.03) << "the twin must fail";
}

}  // namespace
}  // namespace mote

#include "mote/hardware/filters/offspring.hpp"

#include <gtest/gtest.h>

#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {
namespace {

// referee  all 2^17 operands: the product with the operand never exceeds 2^35, and lacks less than 2^-13 of it
TEST(Reciprocal, IsNeverTooLargeAndHasThirteenBits) {
  double worst = 0;
  for (std::uint32_t x = 1U << 17; x < 1U << 18; ++x) {
    const std::uint64_t product = std::uint64_t{reciprocal_of(x)} * x;
    ASSERT_LE(product, std::uint64_t{1} << 35) << x;
    worst = std::max(worst, 1 - std::ldexp(static_cast<double>(product), -35));
  }
  EXPECT_LT(worst, std::exp2(-13));
}

std::vector<ScaledWeight> random_weights(std::size_t n, std::uint64_t seed) {
  Words words(seed, 0);
  std::vector<std::int64_t> log_weights(n);
  for (std::int64_t& log_weight : log_weights) log_weight = -static_cast<std::int64_t>(words.next() >> 18);
  std::vector<ScaledWeight> weights(n);
  scale_weights(log_weights, 4, 24, weights);
  return weights;
}

// claim    a particle's children are N w / sum w, give or take less than one; over all numbers u their mean is N w /
// sum w referee  the weights in double design   N = 4, 8, 100 and 1024; 64 equally spaced u risk     none: no chance;
// rounding moves an end by less than 2^-5, and so the mean, besides the grain of u, by 2^-4
TEST(Offspring, IsWhatTheWeightsSay) {
  for (const std::size_t n : {4U, 8U, 100U, 1024U}) {
    const std::vector<ScaledWeight> weights = random_weights(n, n);
    const std::uint64_t total = sum_of(weights);
    std::vector<double> mean(n);
    for (std::uint32_t u = 0; u < 64; ++u) {
      const std::vector<std::uint32_t> ends = Offspring{24, 10}.ends(weights, total, u << 18);
      ASSERT_EQ(ends.back(), n);
      ASSERT_TRUE(std::is_sorted(ends.begin(), ends.end()));
      for (std::size_t i = 0; i < n; ++i) mean[i] += (ends[i] - (i == 0 ? 0.0 : ends[i - 1])) / 64;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double share = std::ldexp(static_cast<double>(weights[i].weight),
                                      static_cast<int>(8 * (weights[i].scale - weights.back().scale)));
      EXPECT_NEAR(mean[i], static_cast<double>(n) * share / static_cast<double>(total), 0.07) << i << " of " << n;
    }
  }
}

TEST(Offspring, ParentsAreTheFirstWhoseEndIsAbove) {
  const std::vector<std::uint32_t> ends{0, 3, 3, 4, 8, 8, 8, 8};
  EXPECT_EQ(parents_of(ends), (std::vector<std::uint32_t>{1, 1, 1, 3, 4, 4, 4, 4}));
}

}  // namespace
}  // namespace mote::hardware

#include "mote/hardware/filters/weights.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {
namespace {

TEST(LogDrop, IsTheLogarithmWithinItsBound) {
  Words words(3, 0);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const std::uint32_t word = words.next() >> (i % 32);
    if (word == 0) continue;
    worst = std::max(worst, std::abs(static_cast<double>(log_drop(word)) / 1024 + std::log2(std::ldexp(word, -32))));
  }
  EXPECT_LT(worst, std::exp2(-8.0));
  EXPECT_GT(worst, 1e-4) << "ten fraction bits cannot do better";
}

TEST(ScaleWeights, GivesSumsOfPowersWithinATruncation) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> jump(-9000, 10000);
  for (const std::size_t lanes : {1U, 2U, 4U})
    for (int run = 0; run < 100; ++run) {
      std::vector<std::int64_t> log_weights(500, -200000);
      for (std::size_t j = 1; j < log_weights.size(); ++j) log_weights[j] = log_weights[j - 1] + jump(random);
      std::vector<ScaledWeight> weights(log_weights.size());
      scale_weights(log_weights, lanes, 24, weights);
      double exact = 0;
      for (const std::int64_t log_weight : log_weights) exact += std::exp2(static_cast<double>(log_weight) / 1024);
      const double got =
          std::ldexp(static_cast<double>(sum_of(weights)), static_cast<int>(8 * weights.back().scale) - 24);
      EXPECT_NEAR(got / exact, 1, 500.0 / (1 << 16)) << lanes;
    }
}

}  // namespace
}  // namespace mote::hardware

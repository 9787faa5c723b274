#include "mote/hardware/filters/weights.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/words.hpp"

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

TEST(RunningScale, GivesSumsOfPowersWithinATruncation) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> jump(-9000, 10000);
  for (int run = 0; run < 100; ++run) {
    RunningScale scale(24);
    WeightSum sum;
    std::int64_t log_weight = -200000;
    double exact = 0;
    for (int j = 0; j < 500; ++j) {
      log_weight += jump(random);
      const ScaledWeight w = j == 0 ? scale.first(log_weight) : scale.next(log_weight);
      j == 0 ? sum.first(w) : sum.next(w);
      exact += std::exp2(static_cast<double>(log_weight) / 1024);
    }
    const double got = std::ldexp(static_cast<double>(sum.sum()), static_cast<int>(8 * sum.scale()) - 24);
    EXPECT_NEAR(got / exact, 1, 500.0 / (1 << 16));
  }
}

// claim    the words are uniform: bytes, and pairs of neighbouring nibbles
// referee  chi-square with 255 degrees of freedom
// design   2^20 words of 4 streams; fixed seeds
// risk     1e-6 a statistic (chi-square below 375); the twin, words with a bit stuck, must be caught
TEST(Words, AreUniform) {
  const auto statistic = [](unsigned stream, std::uint32_t stuck, auto&& cell) {
    Words words(1, stream);
    std::array<double, 256> counts{};
    std::uint32_t before = words.next();
    constexpr double kExpected = (1 << 20) / 256.0;
    for (int i = 0; i < 1 << 20; ++i) {
      const std::uint32_t word = words.next() | stuck;
      counts[cell(before, word)] += 1;
      before = word;
    }
    double sum = 0;
    for (const double count : counts) sum += (count - kExpected) * (count - kExpected) / kExpected;
    return sum;
  };
  for (unsigned stream = 0; stream < 4; ++stream) {
    for (unsigned shift = 0; shift < 32; shift += 8)
      EXPECT_LT(statistic(stream, 0, [=](auto, std::uint32_t w) { return (w >> shift) & 255; }), 375);
    EXPECT_LT(statistic(stream, 0, [](std::uint32_t b, std::uint32_t w) { return (b >> 28) << 4 | w >> 28; }), 375);
  }
  EXPECT_GT(statistic(0, 1U << 30, [](auto, std::uint32_t w) { return w >> 24; }), 375) << "the twin";
}

}  // namespace
}  // namespace mote::hardware

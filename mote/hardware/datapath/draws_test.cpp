#include "mote/hardware/datapath/draws.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <gtest/gtest.h>

namespace mote::hardware {
namespace {

/// All normal numbers of a draw, in order.
std::vector<double> all_numbers(bool prior) {
  std::vector<double> numbers;
  const int bits = prior ? kPriorBits : kMoveBits;
  for (std::uint32_t m = 0; m < 1U << bits; ++m) numbers.push_back(normal_draw(prior ? m : m << (32 - bits), prior));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

double moment(const std::vector<double>& numbers, int power) {
  double sum = 0;
  for (const double z : numbers) sum += std::pow(z, power);
  return sum / static_cast<double>(numbers.size());
}

/// The greatest distance of the distribution function, at the middle of its steps, from the normal one.
double distance(const std::vector<double>& numbers) {
  const boost::math::normal law;
  const auto n = static_cast<double>(numbers.size());
  double worst = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    worst = std::max(worst, std::abs(boost::math::cdf(law, numbers[k]) - (static_cast<double>(k) + 0.5) / n));
  return worst;
}

struct Law {
  bool prior;
  double distance, reach, sixth;  ///< greatest distance, greatest number, least sixth moment
  std::size_t distinct;
};

// claim    the numbers of all words have the moments 0, 1, 0, 3, 0 of a normal number, a distribution function within
//          0.001 (move) and 0.0015 (prior) of it, and do not fall together
// referee  the normal law; all words, so no chance. The twin (0.5 % too wide) must be caught
TEST(WordDraws, AreNormal) {
  for (const Law& law : {Law{false, 0.001, 4.4, 14.8, 262000}, Law{true, 0.0015, 3.88, 14.7, 16380}}) {
    std::vector<double> numbers = all_numbers(law.prior);
    const double wanted[] = {0, 1, 0, 3, 0};
    for (int power = 1; power <= 5; ++power) EXPECT_NEAR(moment(numbers, power), wanted[power - 1], 1e-9) << power;
    EXPECT_GT(moment(numbers, 6), law.sixth);
    EXPECT_LT(distance(numbers), law.distance);
    EXPECT_GT(numbers.back(), law.reach);
    const auto differ = [](double a, double b) { return b - a < 1e-9; };
    std::vector<double> kept = numbers;
    kept.erase(std::unique(kept.begin(), kept.end(), differ), kept.end());
    EXPECT_GE(kept.size(), law.distinct);
    for (double& z : numbers) z *= 1.005;
    EXPECT_GT(distance(numbers), law.distance);
  }
}

// claim    a circuit's draw is within a step of the number it stands for, times its scale
TEST(WordDraws, AreWithinAStep) {
  for (const bool prior : {false, true})
    for (const double scale : {1.0, -0.37, 40.0}) {
      const Format y{true, 9, 6};
      Sketch sketch("draw", Multiplier::kDsp);
      sketch.output("z_o", WordDraws(sketch).normal(sketch.input("word_i", {true, 0, 31}), prior, scale, y));
      const Compound draw = sketch.done();
      std::vector<Word> words;
      std::vector<Word> drawn(1 << 14);
      for (std::uint32_t k = 0; k < drawn.size(); ++k) words.push_back(static_cast<std::int32_t>(k * 0x9E3779B1U));
      draw.compute(std::array{std::span<const Word>(words)}, std::array{std::span<Word>(drawn)});
      for (std::size_t k = 0; k < drawn.size(); ++k)
        ASSERT_LE(std::abs(y.value(drawn[k]) - scale * normal_draw(static_cast<std::uint32_t>(words[k]), prior)),
                  y.step());
    }
}

}  // namespace
}  // namespace mote::hardware

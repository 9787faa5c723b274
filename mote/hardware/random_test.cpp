#include "mote/hardware/random.hpp"

#include <array>
#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"
#include "mote/hardware/bench_laws.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {
namespace {

constexpr std::size_t kDraws = 4'000'000;
constexpr double kRisk = 4.89;  // |z| beyond which a test with false alarm 1e-6 says no

/// (observed - expected) over its standard deviation.
double score(double observed, double expected, double variance) { return (observed - expected) / std::sqrt(variance); }

/// The chi-square statistic of equally likely cells, as a normal score.
double cell_score(const std::vector<double>& counts, double expected) {
  double statistic = 0;
  for (const double count : counts) statistic += (count - expected) * (count - expected) / expected;
  const boost::math::chi_squared law(static_cast<double>(counts.size() - 1));
  const double above = boost::math::cdf(boost::math::complement(law, statistic));
  return -boost::math::quantile(boost::math::normal(), std::clamp(above, 1e-300, 1 - 1e-16));
}

// source  L'Ecuyer's program taus88, seeds 12345: the recurrence written with its operators, not with our masks
TEST(Words, FollowThePublishedRecurrence) {
  Words ours(12345, 12345, 12345);
  std::uint32_t s1 = 12345;
  std::uint32_t s2 = 12345;
  std::uint32_t s3 = 12345;
  ours.advance();  // the program's first word is that of its first recurrence
  for (int i = 0; i < 1000; ++i) {
    std::uint32_t b = ((s1 << 13U) ^ s1) >> 19U;
    s1 = ((s1 & 4294967294U) << 12U) ^ b;
    b = ((s2 << 2U) ^ s2) >> 25U;
    s2 = ((s2 & 4294967288U) << 4U) ^ b;
    b = ((s3 << 3U) ^ s3) >> 11U;
    s3 = ((s3 & 4294967280U) << 17U) ^ b;
    ASSERT_EQ(ours.next(), s1 ^ s2 ^ s3);
  }
}

TEST(Words, OfNeighbouringStreamsDiffer) {
  for (std::uint32_t stream = 0; stream < 1000; ++stream) {
    Words one(1, stream);
    Words other(1, stream + 1);
    EXPECT_NE(one.next(), other.next());
    EXPECT_NE(one.next(), other.next());
  }
}

// claim    words are uniform: mean, variance, cells of each byte, and no correlation of neighbours, of words or of
// streams referee  the uniform law design   4e6 words of stream 0, seed 1 risk     false alarm 1e-6 a figure; the twin
// (a word whose lowest bit is the next one's) must be caught
TEST(Words, AreUniformAndIndependent) {
  Words generator(1, 0);
  Words other(1, 1);
  double sum = 0, squares = 0, serial = 0, lagged = 0, across = 0, before = 0, before2 = 0;
  std::array<std::vector<double>, 4> bytes;
  bytes.fill(std::vector<double>(256));
  std::vector<double> pairs(65536);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < kDraws; ++i) {
    const std::uint32_t word = generator.next();
    const double u = word * 0x1p-32 - 0.5;
    sum += u;
    squares += u * u;
    serial += u * before;
    lagged += u * before2;
    across += u * (other.next() * 0x1p-32 - 0.5);
    before2 = before;
    before = u;
    for (unsigned byte = 0; byte < 4; ++byte) ++bytes[byte][(word >> (8 * byte)) & 255U];
    if (i % 2 == 1) ++pairs[(word >> 24U) << 8U | last >> 24U];
    last = word;
  }
  const double n = kDraws;
  EXPECT_LT(std::abs(score(sum, 0, n / 12)), kRisk);
  EXPECT_LT(std::abs(score(squares, n / 12, n / 180)), kRisk);
  EXPECT_LT(std::abs(score(serial, 0, n / 144)), kRisk);
  EXPECT_LT(std::abs(score(lagged, 0, n / 144)), kRisk);
  EXPECT_LT(std::abs(score(across, 0, n / 144)), kRisk);
  for (const auto& counts : bytes) EXPECT_LT(std::abs(cell_score(counts, n / 256)), kRisk);
  EXPECT_LT(std::abs(cell_score(pairs, n / 2 / 65536)), kRisk);
}

TEST(Words, TheTestOfPairsCatchesARepeatedByte) {
  Words generator(1, 0);
  std::vector<double> pairs(65536);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < kDraws / 2; ++i) {
    const std::uint32_t word = generator.next();
    ++pairs[(word >> 24U) << 8U | (last >> 24U)];
    last = i % 8 == 0 ? word & 0x7FFFFFFFU : generator.next();
  }
  EXPECT_GT(cell_score(pairs, static_cast<double>(kDraws) / 2 / 65536), kRisk);
}

/// Moments, cells, tails and serial correlation of words that should be standard normal, as scores; fraction bits after
/// the point.
std::vector<double> normal_scores(const std::function<Word()>& draw, int fraction) {
  double sums[5] = {}, serial = 0, before = 0, tails[2] = {};
  std::vector<double> cells(256);
  const boost::math::normal law;
  for (std::size_t i = 0; i < kDraws; ++i) {
    const double z = std::ldexp(static_cast<double>(draw()), -fraction);
    for (int power = 1; power <= 4; ++power) sums[power] += std::pow(z, power);
    serial += z * before;
    before = z;
    ++cells[static_cast<std::size_t>(std::min(255.0, 256 * boost::math::cdf(law, z + std::ldexp(0.5, -fraction))))];
    tails[0] += std::abs(z) > 3;
    tails[1] += std::abs(z) > 4;
  }
  const double n = kDraws;
  const double grain = std::ldexp(1.0, -2 * fraction) / 12;  // what rounding adds to the variance
  const double p3 = 2 * boost::math::cdf(law, -3 - std::ldexp(0.5, -fraction));
  const double p4 = 2 * boost::math::cdf(law, -4 - std::ldexp(0.5, -fraction));
  return {score(sums[1], 0, n),
          score(sums[2], n * (1 + grain), 2 * n),
          score(sums[3], 0, 15 * n),
          score(sums[4], 3 * n, 96 * n),
          score(serial, 0, n),
          score(tails[0], n * p3, n * p3),
          score(tails[1], n * p4, n * p4)};
}

// claim    the normal unit's words have the moments, tails and independence of standard normal numbers
// referee  the normal law
// design   4e6 words of stream 0, seed 1, s3.13
// risk     false alarm 1e-6 a figure; the twin (0.5 % too wide) must be caught
TEST(NormalUnit, IsStandardNormal) {
  const Piecewise unit = normal_unit(13);
  Words generator(1, 0);
  for (const double z : normal_scores([&] { return unit(signed_bits(generator.next())); }, 13))
    EXPECT_LT(std::abs(z), kRisk);
  Words again(1, 0);
  const auto wide = normal_scores([&] { return unit(signed_bits(again.next())) * 1005 / 1000; }, 13);
  EXPECT_GT(std::abs(wide[1]), kRisk);
}

// claim    |error| is at most a step at all points looked at, and the greatest number is beyond 6 sigma
// referee  AS 241 in double
// design   10^7 words of a generator, then the 2^16 smallest tail probabilities of both signs
TEST(NormalUnit, IsWithinAStepUpToSixSigma) {
  const Piecewise unit = normal_unit(12);
  Words generator(2, 0);
  const auto error = [&](Word x) {
    const double m = static_cast<double>(x < 0 ? ~x : x) * 0x1p-31;
    const double want = x < 0 ? -normal_of(m) : normal_of(m);
    return std::abs(static_cast<double>(unit(x)) - want * 4096);
  };
  double worst = 0;
  for (int i = 0; i < 10'000'000; ++i) worst = std::max(worst, error(signed_bits(generator.next())));
  for (Word x = 0; x < 65536; ++x) worst = std::max({worst, error(x), error(~x)});
  EXPECT_LE(worst, 1.02);
  EXPECT_GT(unit(0), 6 * 4096);
  EXPECT_EQ(unit(-1), -unit(0));
}

/// Rows of Box and Muller's numbers from two streams; in the first 20000 u is near its ends.
struct BoxMullerSample {
  Table words, normals;
};

BoxMullerSample box_muller_sample(int fraction, std::size_t rows) {
  BoxMullerSample sample{Table(2, std::vector<Word>(rows)), {}};
  Words first(4, 0);
  Words second(4, 1);
  for (std::size_t i = 0; i < rows; ++i) {
    sample.words[0][i] = signed_bits(first.next());
    sample.words[1][i] = second.next();
  }
  for (Word i = 0; i < 20000; ++i) sample.words[0][static_cast<std::size_t>(i)] = i - 10000;  // both ends of u
  sample.normals = computed(box_muller(fraction), sample.words, rows);
  return sample;
}

// claim    both numbers are within a step of the formula; the greatest is beyond 6 sigma
// referee  the formula in double
TEST(BoxMuller, IsWithinAStep) {
  const auto [words, normals] = box_muller_sample(12, 2'000'000);
  double worst = 0;
  Word most = 0;
  for (std::size_t i = 0; i < words[0].size(); ++i) {
    const double r = radius_of(static_cast<double>(words[0][i]) * 0x1p-31);
    const double angle = 2 * kPi * (static_cast<double>(words[1][i]) * 0x1p-32 - 0.125);
    worst = std::max({worst, std::abs(static_cast<double>(normals[0][i]) - 4096 * r * std::cos(angle)),
                      std::abs(static_cast<double>(normals[1][i]) - 4096 * r * std::sin(angle))});
    most = std::max({most, normals[0][i], normals[1][i]});
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_GT(most, 5 * 4096);
}

// claim    the numbers have the moments, tails and independence of standard normal numbers, and the two of a row do not
// correlate referee  the normal law design   2e6 rows of s3.12, both numbers in turn: 4e6 draws; neighbours are the two
// of a row half of the time risk     false alarm 1e-6 a figure
TEST(BoxMuller, IsStandardNormal) {
  const auto [words, normals] = box_muller_sample(12, 2'020'000);
  std::size_t next = 40000;
  const auto draw = [&] {
    const Word z = normals[next % 2][next / 2];
    ++next;
    return z;
  };
  for (const double score : normal_scores(draw, 12)) EXPECT_LT(std::abs(score), kRisk);
}

TEST(Random, CircuitsEqualTheirTwins) {
  Lockstep all;
  all.add(WordSource{1, 0});
  all.add(WordSource{0x123456789ABCDEF, 123});
  all.add(normal_unit(12));
  all.add(normal_unit(9, Multiplier::kLogic));
  all.add(box_muller(12));
  all.expect_agreement(1'000'000);
}

}  // namespace
}  // namespace mote::hardware

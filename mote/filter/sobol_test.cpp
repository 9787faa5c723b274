#include "mote/filter/sobol.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>

#include <boost/random/sobol.hpp>
#include <gtest/gtest.h>

namespace mote {
namespace {

double fraction(std::uint32_t digits) { return digits * 0x1p-32; }

// The ten points that Joe & Kuo show for three dimensions; they walk in Gray's order.
TEST(Sobol, BeginsAsPublished) {
  const Sobol sobol(3);
  const std::vector<std::array<double, 3>> expected{{0, 0, 0},
                                                    {0.5, 0.5, 0.5},
                                                    {0.75, 0.25, 0.25},
                                                    {0.25, 0.75, 0.75},
                                                    {0.375, 0.375, 0.625},
                                                    {0.875, 0.875, 0.125},
                                                    {0.625, 0.125, 0.875},
                                                    {0.125, 0.625, 0.375},
                                                    {0.1875, 0.3125, 0.9375},
                                                    {0.6875, 0.8125, 0.4375}};
  for (std::uint32_t j = 0; j < expected.size(); ++j)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(fraction(sobol.digits(j ^ j >> 1U, d)), expected[j][d]) << j;
}

// referee  Boost.Random's engine, which leaves out point 0 and walks in Gray's order
TEST(Sobol, IsBoostsSequence) {
  constexpr std::size_t kDimensions = 200;
  const Sobol sobol(kDimensions);
  boost::random::sobol_engine<std::uint32_t, 32> engine(kDimensions);
  for (std::uint32_t j = 1; j <= 1000; ++j)
    for (std::size_t d = 0; d < kDimensions; ++d) ASSERT_EQ(sobol.digits(j ^ j >> 1U, d), engine()) << j << ", " << d;
}

TEST(Sobol, RefusesMoreDimensionsThanItKnows) {
  EXPECT_EQ(Sobol(Sobol::kMostDimensions).dimensions(), Sobol::kMostDimensions);
  EXPECT_THROW(Sobol(Sobol::kMostDimensions + 1), std::invalid_argument);
}

/// How many of the elementary boxes of sides 2^-a and 2^-(k-a), for all a, hold exactly one of 2^k points.
template <class Bits>
bool in_every_elementary_box(unsigned k, Bits&& bits) {
  for (unsigned a = 0; a <= k; ++a) {
    std::set<std::uint64_t> boxes;
    for (std::size_t i = 0; i < std::size_t{1} << k; ++i) {
      const std::uint64_t x = a == 0 ? 0 : bits(i, 0) >> (64 - a);
      const std::uint64_t y = a == k ? 0 : bits(i, 1) >> (64 - (k - a));
      boxes.insert(x << (k - a) | y);
    }
    if (boxes.size() != std::size_t{1} << k) return false;
  }
  return true;
}

// The first two coordinates are a (0, k, 2) net: one point in every elementary box. Scrambling keeps it; independent
// numbers, the twin, do not have it.
TEST(ScrambledPoints, HaveOneInEveryElementaryBox) {
  const Sobol sobol(2);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const unsigned k : {0U, 1U, 4U, 6U, 7U, 10U}) {
      const ScrambledPoints points(sobol, std::size_t{1} << k, {seed, 3});
      EXPECT_TRUE(in_every_elementary_box(k, [&](std::size_t i, std::size_t d) { return points.bits(i, d); })) << k;
    }
  EXPECT_FALSE(in_every_elementary_box(10, [](std::size_t i, std::size_t d) { return mixed(2 * i + d); }));
}

TEST(ScrambledPoints, HaveOneInEveryIntervalOfEveryCoordinate) {
  constexpr std::size_t kDimensions = 40;
  const Sobol sobol(kDimensions);
  const ScrambledPoints points(sobol, 1000, {7, 1});
  for (std::size_t d = 0; d < kDimensions; ++d) {
    std::set<std::uint64_t> intervals;
    for (std::size_t i = 0; i < 512; ++i) intervals.insert(points.bits(i, d) >> (64 - 9));
    EXPECT_EQ(intervals.size(), 512U) << d;
  }
}

// As many points as the digits of a tree's depth can tell apart: nothing is shifted out.
TEST(ScrambledPoints, TellTheMostPointsApart) {
  const Sobol sobol(1);
  const ScrambledPoints points(sobol, std::size_t{1} << 30U, {7, 1});
  std::set<std::uint64_t> intervals;
  for (std::size_t i = 0; i < 1024; ++i) intervals.insert(points.bits((std::size_t{1} << 30U) - 1 - i, 0) >> 54U);
  EXPECT_EQ(intervals.size(), 1024U);
}

TEST(ScrambledPoints, FollowFromSeedStepAndStreamAlone) {
  const Sobol sobol(3);
  const ScrambledPoints points(sobol, 100, {1, 2, 0});
  EXPECT_EQ(points.bits(5, 2), ScrambledPoints(sobol, 100, {1, 2, 0}).bits(5, 2));
  std::set<std::uint64_t> all;
  for (const Draws& other : {Draws{1, 2, 0}, Draws{2, 2, 0}, Draws{1, 3, 0}, Draws{1, 2, 1}})
    for (std::size_t d = 0; d < 3; ++d) all.insert(ScrambledPoints(sobol, 100, other).bits(5, d));
  EXPECT_EQ(all.size(), 12U);
}

// claim    every point of a scrambled sequence is uniform, and the digits of different coordinates are independent
// referee  the uniform law
// design   20 000 seeds; for three points, each of the first 12 and of the last digits of two coordinates, and the
//          parity of each pair of like digits: fair coins
// risk     1e-6 over 3 * 24 * 3 coins (|z| < 6); the twin, the sequence unscrambled, must be caught
TEST(ScrambledPoints, AreUniformEach) {
  const Sobol sobol(2);
  constexpr std::uint64_t kSeeds = 20000;
  const auto worst = [&](bool scrambled) {
    double largest = 0;
    for (const std::size_t point : {0U, 1U, 733U}) {
      std::vector<std::array<double, 3>> ones(64);
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const ScrambledPoints points(sobol, 1000, {seed, 1});
        const auto bits = [&](std::size_t d) {
          return scrambled ? points.bits(point, d)
                           : std::uint64_t{sobol.digits(static_cast<std::uint32_t>(point), d)} << 32U;
        };
        const std::uint64_t x = bits(0);
        const std::uint64_t y = bits(1);
        for (std::size_t k = 0; k < 64; ++k) {
          ones[k][0] += static_cast<double>(x >> (63 - k) & 1U);
          ones[k][1] += static_cast<double>(y >> (63 - k) & 1U);
          ones[k][2] += static_cast<double>((x ^ y) >> (63 - k) & 1U);
        }
      }
      for (std::size_t k = 0; k < 64; ++k)
        if (k < 12 || k >= 52)
          for (const double count : ones[k])
            largest = std::max(largest, std::abs(count - kSeeds / 2.0) / std::sqrt(kSeeds / 4.0));
    }
    return largest;
  };
  EXPECT_LT(worst(true), 6);
  EXPECT_GT(worst(false), 6) << "the twin";
}

// claim    scrambled points integrate a smooth function with an error far below that of random numbers
// referee  the exact integral of x y over the square, 1/4
// design   200 scramblings of 1024 points; random numbers have a root mean square error of 0.22 / 32 = 0.0069
// risk     none: fixed seeds, measured 3e-5, bound 1e-4; the twin (independent numbers) must be above the bound
TEST(ScrambledPoints, IntegrateSmoothFunctions) {
  const Sobol sobol(2);
  const auto error = [&](auto&& bits) {
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const ScrambledPoints points(sobol, 1024, {seed, 1});
      double sum = 0;
      for (std::size_t i = 0; i < 1024; ++i)
        sum += uniform_from_bits(bits(points, i, 0, seed)) * uniform_from_bits(bits(points, i, 1, seed));
      squares += std::pow(sum / 1024 - 0.25, 2) / 200;
    }
    return std::sqrt(squares);
  };
  EXPECT_LT(error([](const auto& points, auto i, auto d, auto) { return points.bits(i, d); }), 1e-4);
  EXPECT_GT(error([](const auto&, auto i, auto d, auto seed) { return mixed((seed * 1024 + i) * 2 + d); }), 1e-4);
}

TEST(PointDraw, HandsOutCoordinatesInOrder) {
  const Sobol sobol(2);
  const ScrambledPoints points(sobol, 16, {1, 1});
  PointDraw<double> draw(points, 3);
  EXPECT_EQ(draw.normal(), normal_from_bits(points.bits(3, 0)));
  EXPECT_EQ(draw.uniform(), uniform_from_bits(points.bits(3, 1)));
  PointDraw<float> single(points, 3);
  EXPECT_EQ(single.normal(), static_cast<float>(normal_from_bits(points.bits(3, 0))));
  EXPECT_NEAR(single.uniform(), uniform_from_bits(points.bits(3, 1)), 1e-6);
}

}  // namespace
}  // namespace mote

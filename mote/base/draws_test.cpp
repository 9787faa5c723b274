#include "mote/base/draws.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace mote {
namespace {

template <class R>
std::vector<double> normals(std::size_t n, std::uint64_t seed) {
  std::vector<double> z(n);
  Draws{seed, 1}.for_each<R>(Purpose::kTest, 0, n,
                             [&](std::size_t i, auto& draw) { z[i] = static_cast<double>(draw.normal()); });
  return z;
}

/// Kolmogorov's distance times sqrt(n) of the sample to the standard normal law of standard deviation `sd`.
double kolmogorov(std::vector<double> z, double sd) {
  std::sort(z.begin(), z.end());
  const auto n = static_cast<double>(z.size());
  double worst = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double p = 0.5 * std::erfc(-z[i] / sd / std::sqrt(2.0));
    worst = std::max({worst, std::abs(p - static_cast<double>(i) / n), std::abs(p - static_cast<double>(i + 1) / n)});
  }
  return worst * std::sqrt(n);
}

// claim    draws are standard normal, in double and in float
// referee  Kolmogorov's law: P(D sqrt(n) > 2.7) = 9e-7
// design   2^20 draws, one fixed seed; the twin (sd 1 % too large) must be caught
// risk     1e-6 each
TEST(Draws, NormalsFollowTheNormalLaw) {
  for (const auto& z : {normals<double>(1U << 20U, 5), normals<float>(1U << 20U, 6)}) {
    EXPECT_LT(kolmogorov(z, 1.0), 2.7);
    EXPECT_GT(kolmogorov(z, 1.01), 2.7);
  }
}

// claim    tails beyond 4 sigma have their mass
// referee  P(|z| > 4) = 6.334e-5: 2^24 draws hold 1062.7 +- 32.6
// risk     1e-6 (|z| < 4.89); the twin (a generator that stops at 4.2 sigma) would hold 1062.7 - 447
TEST(Draws, TailsHaveTheirMass) {
  for (const auto& z : {normals<double>(1U << 24U, 7), normals<float>(1U << 24U, 8)}) {
    const auto beyond =
        static_cast<double>(std::count_if(z.begin(), z.end(), [](double v) { return std::abs(v) > 4; }));
    EXPECT_NEAR(beyond, 1062.7, 4.89 * 32.6);
    const auto cut = static_cast<double>(
        std::count_if(z.begin(), z.end(), [](double v) { return std::abs(v) > 4 && std::abs(v) < 4.2; }));
    EXPECT_GT(std::abs(cut - 1062.7), 4.89 * 32.6);
    EXPECT_GT(*std::max_element(z.begin(), z.end()), 4.9);
  }
}

TEST(Draws, AreAFunctionOfTheAddressAlone) {
  const Draws draws{42, 7};
  auto whole = draws.block(Purpose::kMove, 3);
  std::vector<double> first;
  for (std::size_t i = 0; i < 20; ++i) first.push_back(whole.particle(i).normal());
  auto other = draws.block(Purpose::kMove, 4);  // drawing elsewhere in between changes nothing
  other.particle(0).normal();
  auto again = draws.block(Purpose::kMove, 3);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(again.particle(i).normal(), first[i]);
}

TEST(Draws, DifferAcrossEveryPartOfTheAddress) {
  std::set<std::uint64_t> words;
  int asked = 0;
  for (std::uint64_t seed : {1ULL, 2ULL, 1ULL << 32U})
    for (std::uint32_t step : {0U, 1U, 2U})
      for (const Purpose purpose : {Purpose::kMove, Purpose::kParent})
        for (std::uint32_t block : {0U, 1U})
          for (std::uint32_t lane = 0; lane < 8; ++lane, ++asked)
            words.insert(keyed_generator({seed, step, purpose, block}, lane).next());
  EXPECT_EQ(words.size(), static_cast<std::size_t>(asked));
}

// claim    neighbouring lanes and steps are uncorrelated
// referee  independence: a sample correlation of n pairs is N(0, 1/n)
// risk     1e-6 per pair of streams; the twin (a stream with itself) has correlation 1
TEST(Draws, NeighbouringStreamsAreUncorrelated) {
  constexpr std::size_t kCount = 1U << 18U;
  const auto correlation = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) sum += a[i] * b[i];
    return sum / std::sqrt(static_cast<double>(kCount));
  };
  const auto a = normals<double>(kCount, 1);
  auto shifted = a;
  std::rotate(shifted.begin(), shifted.begin() + 1, shifted.end());
  EXPECT_LT(std::abs(correlation(a, shifted)), 4.89);
  EXPECT_LT(std::abs(correlation(a, normals<double>(kCount, 2))), 4.89);
  EXPECT_GT(correlation(a, a), 100);
}

}  // namespace
}  // namespace mote

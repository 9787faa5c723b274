#include "mote/software/simd/survivors.hpp"

#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace mote {
namespace {

/// Weights in the scales of their blocks, with what a pass of a filter would note of them.
template <class R>
struct Weighted {
  Particles<R> x;  // the particle's own index
  AlignedVector<R> weights;
  BlockSums sums;

  explicit Weighted(const std::vector<R>& given)
      : x(1, given.size()), weights((given.size() + kBlock - 1) / kBlock * kBlock), sums(given.size(), 1) {
    std::copy(given.begin(), given.end(), weights.begin());
    for (std::size_t i = 0; i < given.size(); ++i) x.component(0)[i] = static_cast<R>(i);
    for (std::size_t b = 0; b < sums.blocks(); ++b) {
      using V = lanes::Vector<R>;
      V sum(0);
      for (std::size_t j = 0; j < kBlock; j += V::kLanes) sum = sum + V::load(weights.data() + b * kBlock + j);
      const double all = lanes::sum(sum);
      sums.set(b, {all > 0 ? 0 : -kInfinity, all, all});
    }
  }

  /// Children of every particle, written in shares that begin at the given blocks.
  std::vector<double> children(double u, const std::vector<std::size_t>& shares) const {
    ChildMap map;
    sums.map_children(sums.totals(), u, sums.particles(), map);
    std::vector<double> counts(x.size());
    AlignedVector<R> block(kBlock);
    for (std::size_t s = 0; s < shares.size(); ++s) {
      SurvivorStream<R, 1> stream(1);
      stream.begin(map, x, weights.data(), static_cast<std::uint32_t>(shares[s] * kBlock));
      const std::size_t last = s + 1 < shares.size() ? shares[s + 1] : sums.blocks();
      for (std::size_t b = shares[s]; b < last; ++b) {
        const std::size_t n = std::min(kBlock, x.size() - b * kBlock);
        stream.write(static_cast<std::uint32_t>(b * kBlock), n, {block.data()});
        for (std::size_t j = 0; j < n; ++j) counts[static_cast<std::size_t>(block[j])] += 1;
      }
    }
    return counts;
  }
};

/// The largest |children - N w / sum w|; more than any number if a particle without weight has a child.
template <class R>
double worst_error(const std::vector<R>& weights, const std::vector<double>& counts) {
  long double total = 0;
  for (const R w : weights) total += w;
  double worst = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto expected =
        static_cast<double>(static_cast<long double>(weights[i]) / total * static_cast<long double>(weights.size()));
    worst = std::max(worst, weights[i] > 0 || counts[i] == 0 ? std::abs(counts[i] - expected) : kInfinity);
  }
  return worst;
}

enum class Kind { kUneven, kSparse, kOne, kLast, kEqual, kThin };

template <class R>
std::vector<R> weights_of(Kind kind, std::size_t n) {
  std::mt19937_64 random(n);
  std::exponential_distribution<double> exponential;
  std::vector<R> w(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double e = exponential(random);
    w[i] = static_cast<R>(kind == Kind::kUneven            ? e * e
                          : kind == Kind::kEqual           ? 1
                          : kind == Kind::kSparse && e > 5 ? e
                                                           : 0);
  }
  if (kind == Kind::kThin) {  // a child for each, but for most of every other block; the last particle has theirs
    for (std::size_t i = 0; i < n; ++i) w[i] = i / kBlock % 2 == 0 || i % kBlock < 300 ? 1 : 0;
    w[n - 1] += static_cast<R>(std::count(w.begin(), w.end(), R(0)));
  }
  if (kind == Kind::kOne) w[n / 3] = 1;
  if (kind == Kind::kLast || (kind == Kind::kSparse && n < 5000)) w[n - 1] = 1;
  return w;
}

// Systematic resampling gives floor or ceil of the expected number to everyone. The scan inside a block rounds at R's
// precision, so a count may miss by a child and 1e-3 more.
template <class R>
void expect_systematic_counts() {
  for (const Kind kind : {Kind::kUneven, Kind::kSparse, Kind::kOne, Kind::kLast, Kind::kEqual, Kind::kThin})
    for (const std::size_t n : {std::size_t{1}, std::size_t{7}, std::size_t{1000}, std::size_t{1024}, std::size_t{5000},
                                std::size_t{100000}}) {
      const auto weights = weights_of<R>(kind, n);
      const Weighted<R> particles(weights);
      for (const double u : {0.001, 0.5, 0.999}) {
        const auto counts = particles.children(u, {0});
        EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), static_cast<double>(n));
        EXPECT_LT(worst_error(weights, counts), 1.001 + 1e-6 * static_cast<double>(n))
            << static_cast<int>(kind) << ", " << n << ", " << u;
      }
    }
}

TEST(SurvivorStream, GivesEveryParticleItsExpectedChildren) {
  expect_systematic_counts<float>();
  expect_systematic_counts<double>();
}

TEST(SurvivorStream, SharesOfTheWorkGiveTheSameChildren) {
  std::vector<std::size_t> single(98);
  std::iota(single.begin(), single.end(), std::size_t{0});
  for (const Kind kind : {Kind::kUneven, Kind::kSparse, Kind::kOne, Kind::kLast, Kind::kEqual, Kind::kThin}) {
    const Weighted<float> particles(weights_of<float>(kind, 100000));
    const auto whole = particles.children(0.3, {0});
    EXPECT_EQ(particles.children(0.3, {0, 1, 2, 40, 97}), whole);
    EXPECT_EQ(particles.children(0.3, single), whole);
  }
}

// claim    at N = 2^24 in float no block of particles gains or loses a child to rounding, and no particle more than
// one:
//          where a block ends, its last survivor may take over a child
// referee  sums in long double
// risk     none, exact arithmetic; the twin, a running sum in float, must be caught
TEST(SurvivorStream, IsExactForSixteenMillionFloats) {
  constexpr std::size_t kMany = std::size_t{1} << 24U;
  const auto weights = weights_of<float>(Kind::kUneven, kMany);
  const auto counts = Weighted<float>(weights).children(0.5, {0});
  EXPECT_LT(worst_error(weights, counts), 2);
  const long double total = std::accumulate(weights.begin(), weights.end(), 0.0L);
  double worst_block = 0;
  double worst_naive = 0;
  float running = 0;
  for (std::size_t b = 0; b < kMany / kBlock; ++b) {
    long double expected = 0;
    double got = 0;
    const float before = running;
    for (std::size_t i = b * kBlock; i < (b + 1) * kBlock; ++i) {
      expected += weights[i];
      got += counts[i];
      running += weights[i];
    }
    expected *= kMany / total;
    worst_block = std::max(worst_block, std::abs(static_cast<double>(expected) - got));
    worst_naive = std::max(
        worst_naive,
        std::abs(static_cast<double>(expected - static_cast<long double>(running - before) * (kMany / total))));
  }
  EXPECT_LT(worst_block, 1.01);
  EXPECT_GT(worst_naive, 10) << "the twin";
}

}  // namespace
}  // namespace mote

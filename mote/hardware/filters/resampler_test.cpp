#include "mote/hardware/filters/resampler.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/hardware/filters/estimate.hpp"

namespace mote::hardware {
namespace {

constexpr std::size_t kParticles = 40;
const Formats kFormats{.count_bits = 6};

/// Weights over several scales, so that early ones are lowered, and their shares of the sum.
struct Set {
  std::vector<ScaledWeight> weights = std::vector<ScaledWeight>(kParticles);
  std::vector<double> shares;

  Set() {
    Words words(7, 0);
    std::vector<std::int64_t> log_weights(kParticles);
    for (std::size_t i = 0; i < kParticles; ++i)
      log_weights[i] = static_cast<std::int64_t>(words.next() >> 19) + (i > 5 ? 9000 : 0);
    scale_weights(log_weights, 1, 24, weights);
    double sum = 0;
    for (const std::int64_t log_weight : log_weights)
      sum += shares.emplace_back(std::exp2(static_cast<double>(log_weight) / 1024));
    for (double& share : shares) share /= sum;
  }
};

/// Numbers of children in many resamplings: mean and variance of each particle's.
struct Children {
  std::vector<double> mean = std::vector<double>(kParticles), variance = mean;

  Children(Resampler scheme, const Set& set, int times) {
    ResamplerWords words(scheme, Words(3, 1));
    const std::vector<std::uint64_t> written(kParticles, 100);
    std::vector<double> squares(kParticles);
    for (int k = 0; k < times; ++k) {
      words.end_step();
      const auto walk = words.walk({set.weights, sum_of(set.weights), written}, kFormats, 1);
      std::vector<double> children(kParticles);
      std::vector<std::uint32_t> parents;
      while (parents.size() < kParticles) walk->cycle(true, parents);
      for (const std::uint32_t parent : parents) ++children[parent];
      for (std::size_t i = 0; i < kParticles; ++i) mean[i] += children[i], squares[i] += children[i] * children[i];
    }
    for (std::size_t i = 0; i < kParticles; ++i) {
      mean[i] /= times;
      variance[i] = squares[i] / times - mean[i] * mean[i];
    }
  }
};

/// The largest distance of the mean numbers from N w, in its standard errors; rounding moves them by less than 2^-8.
double worst(const Children& children, const std::vector<double>& shares, std::size_t shift, double times) {
  double most = 0;
  for (std::size_t i = 0; i < kParticles; ++i) {
    const double expected = kParticles * shares[(i + shift) % kParticles];
    const double error = std::sqrt(std::max(children.variance[i], 1e-4) / times);
    most = std::max(most, (std::abs(children.mean[i] - expected) - 0x1p-8) / error);
  }
  return most;
}

class Schemes : public ::testing::TestWithParam<Resampler> {};

// claim    a particle has N w / sum w children in the mean, by every scheme
// referee  the weights in double
// design   40 particles, 20 000 resamplings, fixed seed; weights that spread over several scales
// risk     false alarm 4e-5 (|z| < 4.89 for 40 particles); the twin, weights of the next particle, must be caught
TEST_P(Schemes, GiveChildrenByWeight) {
  constexpr int kTimes = 20'000;
  const Set set;
  const Children children(GetParam(), set, kTimes);
  EXPECT_LT(worst(children, set.shares, 0, kTimes), 4.89);
  EXPECT_GT(worst(children, set.shares, 1, kTimes), 4.89) << "the twin";
}
INSTANTIATE_TEST_SUITE_P(All, Schemes,
                         ::testing::Values(Resampler::kSystematic, Resampler::kResidualSystematic,
                                           Resampler::kRoulette));

// claim    roulette's numbers of children are multinomial: variance N w (1 - w)
// design   as above, particles with N w > 0.1; the standard error of a variance is below 3 %
// risk     false alarm below 1e-5 (5 errors); the twin, systematic, varies less
TEST(Roulette, VariesAsMultinomialDraws) {
  const Set set;
  const Children roulette(Resampler::kRoulette, set, 20'000);
  const Children twin(Resampler::kSystematic, set, 2000);
  double least = 1;
  for (std::size_t i = 0; i < kParticles; ++i) {
    const double expected = kParticles * set.shares[i] * (1 - set.shares[i]);
    if (expected < 0.1) continue;
    EXPECT_NEAR(roulette.variance[i] / expected, 1, 0.15) << i;
    least = std::min(least, twin.variance[i] / expected);
  }
  EXPECT_LT(least, 0.85) << "the twin";
}

// A weight a cycle from the second after the last is written on; 10 cycles to its first child, which takes its turn.
TEST(ResidualWalk, ReadsAWeightACycle) {
  std::vector<std::int64_t> log_weights(4, -20480);
  log_weights[2] = 0;
  std::vector<ScaledWeight> weights(4);
  scale_weights(log_weights, 1, 24, weights);
  const std::vector<std::uint64_t> written{1, 2, 3, 4};
  ResamplerWords words(Resampler::kResidualSystematic, Words(1, 0));
  words.end_step();
  const auto walk = words.walk({weights, sum_of(weights), written}, kFormats, 1);
  std::vector<std::uint64_t> taken;
  std::vector<std::uint32_t> parents;
  while (taken.size() < 4) {
    const std::uint64_t now = walk->now();
    if (walk->cycle(true, parents)) taken.push_back(now);
  }
  EXPECT_EQ(parents, (std::vector<std::uint32_t>(4, 2)));
  EXPECT_EQ(taken, (std::vector<std::uint64_t>{18, 19, 20, 21}));
}

}  // namespace
}  // namespace mote::hardware

#include "mote/lanes/draws.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/lanes/ready_draws.hpp"

namespace mote::lanes {
namespace {

/// The first `count` draws of every particle of a block, by the scalar code and by vectors.
template <class R, class Take, class TakeVector>
void expect_same_draws(Take take, TakeVector take_vector, double tolerance) {
  const Address address{42, 7, Purpose::kTest, 3, 5};
  BlockDraws<R> scalar(address);
  VectorDraw<R> vector(address);
  std::array<R, kWidth<R>> lane{};
  double worst = 0;
  for (std::size_t at = 0; at < kBlock; at += kWidth<R>)
    for (int draw = 0; draw < 3; ++draw) {  // three draws a particle, as a model with three noises takes them
      take_vector(vector).store(lane.data());
      for (std::size_t i = 0; i < kWidth<R>; ++i) {
        auto source = scalar.particle(at + i);
        worst = std::max(worst, std::abs(static_cast<double>(lane[i]) - static_cast<double>(take(source))));
      }
    }
  EXPECT_LE(worst, tolerance);
}

TEST(VectorDraw, UniformNumbersAreTheScalarOnesBitForBit) {
  expect_same_draws<float>([](auto& d) { return d.uniform(); }, [](auto& d) { return d.uniform(); }, 0);
  expect_same_draws<double>([](auto& d) { return d.uniform(); }, [](auto& d) { return d.uniform(); }, 0);
}

TEST(VectorDraw, NormalNumbersAreTheScalarOnesWithinTheTablesError) {
  expect_same_draws<float>([](auto& d) { return d.normal(); }, [](auto& d) { return d.normal(); }, 6e-6);
  expect_same_draws<double>([](auto& d) { return d.normal(); }, [](auto& d) { return d.normal(); }, 2e-9);
}

/// Numbers made ahead are those drawn one by one, bit for bit, also in blocks that reach far into the tail.
template <class R>
void expect_same_made_ahead(std::size_t draws) {
  const DrawPattern pattern{std::vector<bool>(draws, true)};
  std::vector<R> ahead(draws * kBlock);
  std::array<R, kWidth<R>> lane{};
  std::size_t tails = 0;
  for (std::uint32_t block = 0; block < 400; ++block) {
    const Address address{42, 7, Purpose::kTest, block};
    VectorDraw<R> source(address);
    make_ready(source, pattern, kBlock, ahead.data());
    VectorDraw<R> one(address);
    for (std::size_t at = 0; at < kBlock; at += kWidth<R>)
      for (std::size_t k = 0; k < draws; ++k) {
        one.normal().store(lane.data());
        for (std::size_t i = 0; i < kWidth<R>; ++i) {
          ASSERT_EQ(ahead[k * kBlock + at + i], lane[i]) << block;
          if (std::abs(lane[i]) > R(4.33)) ++tails;  // Phi(-4.33) < 2^-17
        }
      }
  }
  EXPECT_GT(tails, 0U);
}
TEST(VectorDraw, NumbersMadeAheadAreThoseDrawnOneByOne) {
  for (const std::size_t draws : {1, 3}) {
    expect_same_made_ahead<float>(draws);
    expect_same_made_ahead<double>(draws);
  }
}

template <class R>
void expect_same_indices() {
  const Address address{42, 7, Purpose::kTest, 3, 5};
  std::array<std::uint32_t, kWidth<R>> lane{};
  for (const std::uint32_t n : {1U, 2U, 1000U, 99991U, 1U << 28U}) {
    BlockDraws<R> scalar(address);
    VectorDraw<R> vector(address);
    for (std::size_t at = 0; at < kBlock; at += kWidth<R>) {
      vector.index(n, lane.data());
      for (std::size_t i = 0; i < kWidth<R>; ++i) ASSERT_EQ(lane[i], scalar.particle(at + i).index(n)) << n;
    }
  }
}
TEST(VectorDraw, IndicesAreTheScalarOnes) {
  expect_same_indices<float>();
  expect_same_indices<double>();
}

// claim    normal() has the normal law, tails included
// referee  its probabilities beyond 1 .. 5 standard deviations and its first four moments
// design   2^26 draws of one seed
// risk     false alarm 1e-6 each (|z| < 4.89); the twin (draws scaled by 1.001) must be caught
template <class R>
double worst_z(R scale) {
  constexpr std::size_t kDraws = std::size_t{1} << 26U;
  std::array<double, 4> sums{};
  std::array<double, 5> beyond{};
  std::array<R, kWidth<R>> lane{};
  for (std::size_t block = 0; block < kDraws / kBlock; ++block) {
    VectorDraw<R> draw({1, 1, Purpose::kTest, static_cast<std::uint32_t>(block)});
    for (std::size_t at = 0; at < kBlock; at += kWidth<R>) {
      draw.normal().store(lane.data());
      for (const R one : lane) {
        const auto z = static_cast<double>(one * scale);
        double power = 1;
        for (double& sum : sums) sum += power *= z;
        for (std::size_t k = 0; k < 5; ++k) beyond[k] += std::abs(z) > static_cast<double>(k) + 1 ? 1 : 0;
      }
    }
  }
  const auto n = static_cast<double>(kDraws);
  const std::array<double, 4> expected{0, 1, 0, 3};
  const std::array<double, 4> variance{1, 2, 15, 96};
  double worst = 0;
  for (std::size_t k = 0; k < 4; ++k)
    worst = std::max(worst, std::abs(sums[k] / n - expected[k]) / std::sqrt(variance[k] / n));
  for (std::size_t k = 0; k < 5; ++k) {
    const double p = std::erfc((static_cast<double>(k) + 1) / std::sqrt(2.0));
    worst = std::max(worst, std::abs(beyond[k] - n * p) / std::sqrt(n * p));
  }
  return worst;
}
TEST(VectorDraw, NormalNumbersHaveTheNormalLaw) {
  EXPECT_LT(worst_z<float>(1), 4.89);
  EXPECT_LT(worst_z<double>(1), 4.89);
}
TEST(VectorDraw, TwinDrawsATenthOfAPercentTooWideAreCaught) { EXPECT_GT(worst_z<float>(1.001F), 4.89); }

}  // namespace
}  // namespace mote::lanes

#include "mote/software/simd/curve_parents.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

// claim    places of vectors of cells are those of one cell at a time
// referee  hilbert_place()
TEST(HilbertPlaces, AreThoseOfOneCellAtATime) {
  for (const auto& [dimensions, digits] : {std::pair{2U, 11U}, {2U, 16U}, {3U, 10U}, {4U, 8U}, {16U, 2U}, {32U, 1U}}) {
    std::vector<AlignedVector<std::uint32_t>> cells(dimensions, AlignedVector<std::uint32_t>(kBlock));
    for (std::size_t d = 0; d < dimensions; ++d)
      for (std::size_t j = 0; j < kBlock; ++j)
        cells[d][j] = static_cast<std::uint32_t>(mixed(d * kBlock + j)) >> (32 - digits);
    const auto before = cells;
    AlignedVector<std::uint32_t> places(kBlock);
    hilbert_places(cells, digits, kBlock - 3, places.data());
    for (std::size_t j = 0; j < kBlock - 3; ++j) {
      std::vector<std::uint32_t> cell;
      for (const auto& column : before) cell.push_back(column[j]);
      EXPECT_EQ(places[j], hilbert_place(cell, digits)) << dimensions << " dimensions, cell " << j;
    }
  }
}

/// Weighted particles in blocks of scales of their own; some weigh nothing, some are no number.
template <class R>
struct Scattered {
  Particles<R> x;
  AlignedVector<R> weights;
  BlockSums sums;
  std::vector<double> linear;
  std::vector<Moments> moments;

  Scattered(std::size_t n, std::size_t dimensions, double rough)
      : x(dimensions, n), weights((n + kBlock - 1) / kBlock * kBlock), sums(n, dimensions), linear(n) {
    Draws{11, static_cast<std::uint32_t>(n)}.for_each(Purpose::kTruth, 0, n, [&](std::size_t i, auto& draw) {
      for (std::size_t d = 0; d < dimensions; ++d) x.component(d)[i] = static_cast<R>(3 + 2 * draw.normal());
      const bool nothing = draw.uniform() < 0.2;
      weights[i] = nothing ? R(0) : static_cast<R>(std::exp2(rough * draw.normal()));
      if (nothing && i % 3 == 0) x.component(0)[i] = std::numeric_limits<R>::quiet_NaN();
    });
    for (std::size_t b = 0; b < sums.blocks(); ++b) {
      const double shift = static_cast<double>(b % 5) - 2;
      WeightSums block{shift, 0, 0};
      for (std::size_t i = b * kBlock; i < std::min(n, (b + 1) * kBlock); ++i) {
        block.weight += static_cast<double>(weights[i]);
        linear[i] = static_cast<double>(weights[i]) * std::exp2(shift);
      }
      sums.set(b, block);
    }
    for (std::size_t d = 0; d < dimensions; ++d) moments.push_back({3, 2});
  }
};

std::vector<Quantity> quantities(std::size_t dimensions) {
  return std::vector<Quantity>(dimensions, Quantity{"x", ""});
}

template <class R>
std::vector<Index> chosen(const Scattered<R>& particles, double u, std::size_t threads) {
  Crew crew(threads);
  CurveParents<R> parents(quantities(particles.x.dimensions()), particles.x.size());
  const Totals totals = particles.sums.totals();
  const auto all =
      parents.choose({particles.x, particles.weights.data(), particles.sums, totals}, particles.moments, u, crew);
  return {all.begin(), all.end()};
}

// claim    parents lie in the curve's order, and the shares of the weight say how many children each has
// referee  in one dimension the value: children's values never fall by more than a cell. The children of the ordered
//          particles 0..k are within one of N times their share
// design   N of one block, of some, and of several chunks of work; flat and rough weights, a block scale each
// risk     none: fixed seeds. The twin (parents in the particles' own order) must be caught
template <class R>
void expect_shares_in_order(std::size_t n, double rough) {
  const Scattered<R> particles(n, 1, rough);
  const std::vector<Index> parents = chosen(particles, 0.3, 1);
  ASSERT_EQ(parents.size(), n);
  const auto value = [&](Index i) {
    const auto x = static_cast<double>(particles.x.component(0)[i]);
    return std::isnan(x) ? -kInfinity : x;
  };
  const auto steps_back = [&](const std::vector<Index>& order) {
    std::size_t back = 0;
    for (std::size_t k = 1; k < n; ++k) back += value(order[k]) < value(order[k - 1]) - 0.002 ? 1U : 0U;
    return back;
  };
  EXPECT_EQ(steps_back(parents), 0U);
  double total = 0;
  for (const double w : particles.linear) total += w;
  std::vector<std::size_t> children(n);
  for (const Index i : parents) {
    ASSERT_LT(i, n);
    EXPECT_GT(particles.linear[i], 0.0) << "a particle that weighs nothing has a child";
    ++children[i];
  }
  std::vector<Index> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<Index>(i);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return value(a) < value(b); });
  double expected = 0;
  double got = 0;
  double worst = 0;
  for (const Index i : order) {
    if (particles.linear[i] == 0) continue;
    expected += particles.linear[i] / total * static_cast<double>(n);
    got += static_cast<double>(children[i]);
    worst = std::max(worst, std::abs(got - expected));
  }
  // particles that share a cell may stand in another order: their children are few
  EXPECT_LT(worst, 1.5 + static_cast<double>(n) * 1e-3);
  EXPECT_GT(steps_back(order) + steps_back([&] {
              std::vector<Index> own(n);
              for (std::size_t i = 0; i < n; ++i) own[i] = static_cast<Index>(i);
              return own;
            }()),
            n / 4)
      << "the twin";
}

TEST(CurveParents, HaveChildrenByTheirSharesInOrder) {
  for (const double rough : {0.0, 2.0}) {
    expect_shares_in_order<float>(1000, rough);
    expect_shares_in_order<double>(1000, rough);
    expect_shares_in_order<float>(5000, rough);
    expect_shares_in_order<double>(40001, rough);
  }
}

TEST(CurveParents, GoToTheOnlyOneThatWeighs) {
  for (const std::size_t heavy : {0UL, 700UL, 2499UL}) {
    Scattered<float> particles(2500, 2, 0);
    std::fill(particles.weights.begin(), particles.weights.end(), 0.0F);
    particles.weights[heavy] = 1;
    for (std::size_t b = 0; b < particles.sums.blocks(); ++b)
      particles.sums.set(b, b == heavy / kBlock ? WeightSums{0, 1, 1} : WeightSums{-kInfinity, 0, 0});
    for (const double u : {1e-9, 0.5, 1 - 1e-9})
      for (const Index parent : chosen(particles, u, 1)) ASSERT_EQ(parent, heavy);
  }
}

// Several chunks of work, in dimensions of two and three passes of the sort.
TEST(CurveParents, AreTheSameForAnyNumberOfThreads) {
  for (const std::size_t dimensions : {1UL, 2UL, 4UL, 40UL}) {
    const Scattered<double> particles(100001, dimensions, 2);
    const std::vector<Index> one = chosen(particles, 0.7, 1);
    for (const std::size_t threads : {2UL, 3UL, 8UL}) EXPECT_EQ(chosen(particles, 0.7, threads), one) << threads;
    EXPECT_NE(chosen(particles, 0.2, 1), one);
  }
}

}  // namespace
}  // namespace mote

#include "mote/filter/hilbert.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mote/base/draws.hpp"

namespace mote {
namespace {

std::vector<std::uint32_t> cell_of(std::uint64_t number, std::size_t dimensions, unsigned digits) {
  std::vector<std::uint32_t> cell(dimensions);
  for (std::uint32_t& c : cell) {
    c = static_cast<std::uint32_t>(number & ((std::uint64_t{1} << digits) - 1));
    number >>= digits;
  }
  return cell;
}

/// The cells of a cube by their places; a place that is missing or taken twice fails.
std::vector<std::vector<std::uint32_t>> walk(std::size_t dimensions, unsigned digits) {
  const std::uint64_t cells = std::uint64_t{1} << (dimensions * digits);
  std::vector<std::vector<std::uint32_t>> by_place(cells);
  for (std::uint64_t n = 0; n < cells; ++n) {
    const auto cell = cell_of(n, dimensions, digits);
    auto scratch = cell;
    const std::uint64_t place = hilbert_place(scratch, digits);
    EXPECT_LT(place, cells);
    EXPECT_TRUE(by_place[place].empty()) << "two cells at " << place;
    by_place[place] = cell;
  }
  return by_place;
}

TEST(Hilbert, VisitsEveryCellOnceAndMovesAcrossFaces) {
  for (const auto& [dimensions, digits] : {std::pair{1U, 5U}, {2U, 1U}, {2U, 5U}, {3U, 3U}, {4U, 3U}, {6U, 2U}}) {
    const auto cells = walk(dimensions, digits);
    for (std::size_t n = 1; n < cells.size(); ++n) {
      std::uint64_t distance = 0;
      for (std::size_t d = 0; d < dimensions; ++d)
        distance += static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(cells[n][d]) - cells[n - 1][d]));
      ASSERT_EQ(distance, 1U) << dimensions << " dimensions, place " << n;
    }
  }
}

TEST(Hilbert, PlacesFitIntoAWord) {
  EXPECT_EQ(hilbert_digits(2), 19U);
  for (std::size_t d = 1; d <= 64; ++d) {
    EXPECT_LE(d * hilbert_digits(d), 64U) << d;
    EXPECT_GE(hilbert_digits(d), 1U) << d;
  }
  EXPECT_EQ(hilbert_digits(1000), 1U);
  std::vector<std::uint32_t> corner{0xFFFFFFFF, 0};
  EXPECT_NE(hilbert_place(corner, 32), 0U);
}

std::vector<Placed> placed(const Particles<double>& x, const std::vector<Quantity>& states) {
  const std::vector<double> weights(x.size(), 1.0);
  std::vector<Placed> order;
  place_particles({&x, weights, static_cast<double>(x.size())}, states, order);
  return order;
}

TEST(PlaceParticles, SortsOneDimensionByValue) {
  Particles<double> x(1, 6);
  const std::vector<double> values{3, -kInfinity, 0.0, -2, 1e-300, -1e9};
  std::copy(values.begin(), values.end(), x.component(0).begin());
  std::vector<double> sorted;
  for (const Placed& p : placed(x, {{"x", ""}})) sorted.push_back(values[p.index]);
  EXPECT_EQ(sorted, (std::vector<double>{-kInfinity, -1e9, -2, 0.0, 1e-300, 3}));
}

TEST(PlaceParticles, CutsAnAngleOppositeItsMean) {
  Particles<double> x(1, 4);
  const std::vector<double> values{3.1, -3.1, 3.0, -3.0};  // about pi
  std::copy(values.begin(), values.end(), x.component(0).begin());
  std::vector<double> sorted;
  for (const Placed& p : placed(x, {{"x", "rad", true}})) sorted.push_back(values[p.index]);
  EXPECT_EQ(sorted, (std::vector<double>{3.0, 3.1, -3.1, -3.0}));
}

// Along the order, neighbours are near: the path through 4096 points of a square is a small part of the path through
// them as they come (the twin).
TEST(PlaceParticles, MakesAShortPath) {
  Particles<double> x(2, 4096);
  Draws{1, 1}.for_each(Purpose::kTest, 0, x.size(), [&](std::size_t i, auto& draw) {
    x.component(0)[i] = 1e6 + draw.normal();
    x.component(1)[i] = 1e-6 * draw.normal();
  });
  const auto order = placed(x, {{"x", ""}, {"y", ""}});
  const auto length = [&](auto&& at) {
    double sum = 0;
    for (std::size_t n = 1; n < x.size(); ++n)
      sum += std::hypot(x.component(0)[at(n)] - x.component(0)[at(n - 1)],
                        1e6 * (x.component(1)[at(n)] - x.component(1)[at(n - 1)]));
    return sum;
  };
  EXPECT_LT(length([&](std::size_t n) { return order[n].index; }), 0.1 * length([](std::size_t n) { return n; }));
}

TEST(PlaceParticles, TakesWhatIsNotANumberAndWhatDoesNotVary) {
  Particles<double> x(3, 5);
  x.component(0)[2] = kNaN;
  x.component(1)[1] = kInfinity;
  EXPECT_EQ(placed(x, {{"x", ""}, {"y", ""}, {"z", ""}}).size(), 5U);
  Particles<double> wide(70, 8);
  for (std::size_t i = 0; i < 8; ++i) wide.component(3)[i] = static_cast<double>(i % 2);
  std::vector<Quantity> states(70, {"x", ""});
  const auto order = placed(wide, states);
  EXPECT_EQ(order[0].index % 2, order[3].index % 2) << "the halves lie together";
}

}  // namespace
}  // namespace mote

#include "mote/design/frontier.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace mote::design {
namespace {

TEST(Frontier, KeepsWhatNothingBeatsAndEqualPointsTogether) {
  EXPECT_EQ(frontier({{1, 5}, {2, 2}, {2, 3}, {5, 1}, {2, 2}, {6, 6}}), (std::vector<std::size_t>{0, 1, 3, 4}));
  EXPECT_TRUE(frontier({}).empty());
}

/// By the words of the definition.
std::vector<std::size_t> by_definition(const std::vector<Point>& points, bool strictly) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto beats = [&](const Point& p) {
      bool smaller = false;
      for (std::size_t f = 0; f < p.size(); ++f) {
        if (strictly ? p[f] >= points[k][f] : p[f] > points[k][f]) return false;
        smaller = smaller || p[f] < points[k][f];
      }
      return smaller;
    };
    if (std::none_of(points.begin(), points.end(), beats)) found.push_back(k);
  }
  return found;
}

// claim    the frontier is that of the definition
// referee  every pair of points
// design   500 sets of 60 points in 2 to 5 figures, whole numbers up to 5, so that figures tie
// twin     a definition by which a point has to be smaller in all figures must differ
TEST(Frontier, IsWhatEveryPairSays) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> figure(0, 5);
  int differs = 0;
  for (int k = 0; k < 500; ++k) {
    std::vector<Point> points(60, Point(static_cast<std::size_t>(2 + k % 4)));
    for (Point& point : points)
      for (double& x : point) x = figure(random);
    const auto found = frontier(points);
    ASSERT_EQ(found, by_definition(points, false));
    differs += found != by_definition(points, true) ? 1 : 0;
  }
  EXPECT_GT(differs, 250);
}

TEST(BestWithin, TakesTheLeastOfTheGoalThatKeepsAllLimits) {
  const std::vector<Point> points{{1, 9, 9}, {3, 4, 2}, {2, 5, 2}, {2, 5, 1}};
  const Choice found = best_within(points, {{1, 5}, {2, 3}}, 0);
  EXPECT_TRUE(found.feasible);
  EXPECT_EQ(found.place, 3U) << "ties go to the less of what is left";
  EXPECT_EQ(best_within(points, {}, 0).place, 0U);
}

// By hand: within 4 and 1 the points exceed them by the factors 2.25 and 9, 2 (of the third figure), 2, 1.25.
TEST(BestWithin, NamesTheNearestAndWhatItBreaks) {
  const std::vector<Point> points{{1, 9, 9}, {3, 4, 2}, {2, 5, 2}, {2, 5, 1}};
  const Choice found = best_within(points, {{1, 4}, {2, 1}}, 0);
  EXPECT_FALSE(found.feasible);
  EXPECT_EQ(found.place, 3U);
  EXPECT_EQ(found.broken, std::vector<std::size_t>{0});
  EXPECT_DOUBLE_EQ(excess(points[3], {{1, 4}, {2, 1}}), 1.25);
  EXPECT_DOUBLE_EQ(excess(points[3], {{1, 8}}), 1);
}

}  // namespace
}  // namespace mote::design

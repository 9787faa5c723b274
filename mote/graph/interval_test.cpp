#include "mote/graph/interval.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mote/graph/node.hpp"

namespace mote::graph {
namespace {

/// Bounds of f(x, y) for x in [a], y in [b].
template <class F>
Interval bounds(const F& f, const Interval& a, const Interval& b = {0, 0}) {
  Graph graph;
  const Node x(graph, graph.input(Role::kState, 0));
  const Node y(graph, graph.input(Role::kState, 1));
  const Id output = f(x, y).id_in(graph);
  return intervals(graph, [&](const Vertex& v) { return v.index == 0 ? a : b; })[output];
}

TEST(Intervals, AreThoseOfTheBooks) {
  EXPECT_EQ(bounds([](Node x, Node y) { return x + y; }, {-1, 2}, {3, 5}), (Interval{2, 7}));
  EXPECT_EQ(bounds([](Node x, Node y) { return x - y; }, {-1, 2}, {3, 5}), (Interval{-6, -1}));
  EXPECT_EQ(bounds([](Node x, Node y) { return x * y; }, {-1, 2}, {-3, 5}), (Interval{-6, 10}));
  EXPECT_EQ(bounds([](Node x, Node) { return x * x; }, {-3, 2}), (Interval{0, 9})) << "a square is never negative";
  EXPECT_EQ(bounds([](Node x, Node y) { return x / y; }, {-1, 2}, {2, 4}), (Interval{-0.5, 1}));
  EXPECT_EQ(bounds([](Node x, Node y) { return x / y; }, {1, 2}, {-1, 4}), Interval{});
  EXPECT_EQ(bounds([](Node x, Node) { return abs(x); }, {-3, 2}), (Interval{0, 3}));
  EXPECT_EQ(bounds([](Node x, Node) { return cos(x); }, {-0.5, 1}), (Interval{std::cos(1.0), 1}));
  EXPECT_EQ(bounds([](Node x, Node) { return sin(x); }, {0, 4}), (Interval{std::sin(4.0), 1}));
  EXPECT_EQ(bounds([](Node x, Node) { return tan(x); }, {1, 2}), Interval{});
  EXPECT_EQ(bounds([](Node x, Node y) { return select(less(x, y), x, y); }, {0, 1}, {2, 3}), (Interval{0, 1}));
  EXPECT_EQ(bounds([](Node x, Node) { return log(x); }, {-1, 1}).high, 0);
}

// claim    every value lies within the bounds
// referee  the operations themselves, at points within random boxes
// design   all operations, 200 boxes of 50 points, one fixed seed; 1e-12 for the rounding of the bounds
// twin     boxes of half the width, from which some value must escape
TEST(Intervals, HoldEveryValue) {
  Graph graph;
  const Node x(graph, graph.input(Role::kState, 0));
  const Node y(graph, graph.input(Role::kState, 1));
  for (const Node& node : {x + y, x - y, x * y, x * x, x / y, -x, abs(x), floor(x), sqrt(x), exp(x), log(x), sin(x),
                           cos(x), tan(x), atan(x), atan2(x, y), select(less(x, y), x * y, y)})
    ASSERT_FALSE(node.is_constant());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4, 4);
  std::uniform_real_distribution<double> share(0, 1);
  std::size_t escaped = 0;
  for (int box = 0; box < 200; ++box) {
    const std::array<double, 2> centre{place(random), place(random)};
    const double half = std::abs(place(random));
    const auto box_of = [&](double width) {
      return intervals(graph, [&](const Vertex& v) {
        return Interval{centre[v.index] - width, centre[v.index] + width};
      });
    };
    const auto all = box_of(half);
    const auto twin = box_of(half / 2);
    for (int k = 0; k < 50; ++k) {
      const std::array<double, 2> at{centre[0] + half * (2 * share(random) - 1),
                                     centre[1] + half * (2 * share(random) - 1)};
      std::vector<double> values;
      evaluate(
          graph, [&](const Vertex& v) { return at[v.index]; }, values);
      for (Id id = 0; id < graph.size(); ++id) {
        if (std::isnan(values[id])) continue;
        const double slack = 1e-12 * (1 + std::abs(values[id]));
        EXPECT_GE(values[id], all[id].low - slack) << name_of(graph[id].op);
        EXPECT_LE(values[id], all[id].high + slack) << name_of(graph[id].op);
        escaped += !twin[id].contains(values[id]);
      }
    }
  }
  EXPECT_GT(escaped, 1000U);
}

}  // namespace
}  // namespace mote::graph

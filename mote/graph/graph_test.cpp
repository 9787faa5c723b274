#include "mote/graph/graph.hpp"

#include <gtest/gtest.h>

#include "mote/graph/node.hpp"

namespace mote::graph {
namespace {

TEST(Graph, HoldsEqualVerticesOnce) {
  Graph graph;
  const Id x = graph.input(Role::kState, 0);
  EXPECT_EQ(graph.input(Role::kState, 0), x);
  EXPECT_NE(graph.input(Role::kState, 1), x);
  EXPECT_NE(graph.input(Role::kBefore, 0), x);
  EXPECT_EQ(graph.constant(0.5), graph.constant(0.5));
  EXPECT_NE(graph.constant(0.0), graph.constant(-0.0));
  EXPECT_EQ(graph.operation(Op::kAdd, {x, x}), graph.operation(Op::kAdd, {x, x}));
  EXPECT_NE(graph.operation(Op::kAdd, {x, x}), graph.operation(Op::kMultiply, {x, x}));
}

TEST(Graph, KeepsConstantsApartWhenAsked) {
  Graph graph(Constants::kApart);
  EXPECT_NE(graph.constant(0.5), graph.constant(0.5));
}

TEST(Node, CombinesConstantsAsDoublesAre) {
  Graph graph;
  const Node sum = exp(Node(0.3)) * Node(7) - select(less(Node(1), Node(2)), Node(0.1), Node(0.2));
  ASSERT_TRUE(sum.is_constant());
  EXPECT_EQ(sum.constant(), std::exp(0.3) * 7 - 0.1);
  EXPECT_EQ(graph.size(), 0U);
}

TEST(Node, RecordsWhatMeetsAVertex) {
  Graph graph;
  const Node x(graph, graph.input(Role::kState, 0));
  const Node y = atan2(sqrt(x + Node(1)), x);
  const Vertex& last = graph[y.id_in(graph)];
  EXPECT_EQ(last.op, Op::kAtan2);
  EXPECT_EQ(last.args[1], 0U);
  EXPECT_EQ(graph[last.args[0]].op, Op::kSqrt);
  EXPECT_EQ(graph.size(), 5U);
}

TEST(Graph, CountsWhatOutputsDependOn) {
  Graph graph;
  const Node x(graph, graph.input(Role::kState, 0));
  const Node used = x * Node(3) + x * x;
  const Node unused = exp(x);
  const std::array<Id, 1> outputs{used.id_in(graph)};
  const std::map<std::string, std::size_t> expected{{"add", 1}, {"multiply", 1}, {"multiply by constant", 1}};
  EXPECT_EQ(operations(graph, outputs), expected);
  EXPECT_FALSE(reached(graph, outputs)[unused.id_in(graph)]);
}

}  // namespace
}  // namespace mote::graph

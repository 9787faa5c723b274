#include "mote/graph/interpreter.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mote/graph/record.hpp"
#include "mote/graph/simplify.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/law_numbers.hpp"
#include "mote/model/ungm.hpp"

namespace mote::graph {
namespace {

using laws::Pack;
using Columns = std::vector<std::vector<double>>;

/// Numbers for the columns of a block.
Columns columns(std::mt19937& random, std::size_t many, std::size_t count) {
  std::normal_distribution<double> normal;
  Columns all(many, std::vector<double>(count));
  for (auto& column : all)
    for (double& v : column) v = normal(random);
  return all;
}

template <class T>
std::vector<T*> pointers(Columns& columns) {
  std::vector<T*> all;
  for (auto& column : columns) all.push_back(column.data());
  return all;
}

/// What a program gives for a block and for its particles one by one.
///
/// shape   the number of particles is no multiple of the tile, nor of the lanes
void expect_block_equals_particles(const Program& program, std::size_t states, std::size_t draws, std::size_t outputs,
                                   const Row<double>& row) {
  constexpr std::size_t kCount = 603;
  std::mt19937 random(3);
  Columns x = columns(random, states, 604);
  const Columns z = columns(random, draws, 604);
  Columns out(outputs, std::vector<double>(604));
  std::vector<double> numbers(draws * kBlock);
  for (std::size_t k = 0; k < draws; ++k)
    std::copy(z[k].begin(), z[k].end(), numbers.begin() + static_cast<std::ptrdiff_t>(k * kBlock));
  const Row<Pack> packed = row.as<Pack>();
  Interpreter<Pack>(program).run(5, &packed, pointers<const double>(x).data(), numbers.data(),
                                 pointers<double>(out).data(), 0, kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    std::vector<double> state;
    std::vector<double> drawn;
    for (const auto& column : x) state.push_back(column[i]);
    for (const auto& column : z) drawn.push_back(column[i]);
    std::vector<double> expected(outputs);
    program.run<double>(5, {.state = state.data(), .before = state.data(), .row = &row, .draws = drawn.data()},
                        expected.data());
    for (std::size_t k = 0; k < outputs; ++k) ASSERT_EQ(out[k][i], expected[k]) << "output " << k << ", particle " << i;
  }
}

/// The recording of a model with its schedule at t put in as constants.
Outputs at_step(const Recorded& recorded, const std::vector<Id>& outputs, Step t) {
  const std::vector<double> schedule = recorded.schedule(t);
  Graph graph;
  std::vector<Id> now;
  for (const Vertex& v : recorded.graph.vertices()) {
    std::array<Id, 4> args{};
    for (std::size_t k = 0; k < arity(v.op); ++k) args[k] = now[v.args[k]];
    now.push_back(v.op == Op::kConstant       ? graph.constant(v.value)
                  : v.op != Op::kInput        ? graph.operation(v.op, args)
                  : v.role == Role::kSchedule ? graph.constant(schedule[v.index])
                                              : graph.input(v.role, v.index));
  }
  std::vector<Id> ids;
  for (const Id id : outputs) ids.push_back(now[id]);
  return {graph, ids};
}

TEST(Interpreter, MovesAndWeighsGrowthModels) {
  const Recorded recorded = record(Ungm<2>{});
  const Outputs move = at_step(recorded, recorded.next, 5);
  expect_block_equals_particles(Program(move.graph, move.ids), 2, 2, 2, {});
  const Outputs weigh = at_step(recorded, {recorded.log_likelihood}, 5);
  expect_block_equals_particles(Program(weigh.graph, weigh.ids), 2, 0, 1, Row<double>::of({3.5, 1.0}));
}

TEST(Interpreter, MovesAndWeighsDirections) {
  const Recorded recorded = record(Doa{{.correlation = 0.3, .dof = 4}, 3});
  const Outputs move = at_step(recorded, recorded.next, 5);
  expect_block_equals_particles(Program(move.graph, move.ids), 3, 3, 3, {});
  const Outputs weigh = at_step(recorded, {recorded.log_likelihood}, 5);
  expect_block_equals_particles(Program(weigh.graph, weigh.ids), 3, 0, 1, Row<double>::of({0.4, 0.5, 0.45}));
}

TEST(Interpreter, HasEveryOperation) {
  Graph graph;
  const Node x(graph, graph.input(Role::kState, 0));
  const Node z(graph, graph.input(Role::kNormal, 0));
  const Node t(graph, graph.input(Role::kTime, 0));
  const Node y(graph, graph.input(Role::kColumn, 0));
  const std::vector<Node> nodes{
      x + z,  x - z,       x * z,  x / z,  -x,     abs(x),  floor(x),    sqrt(abs(x)),
      exp(x), log(abs(x)), sin(x), cos(x), tan(x), atan(x), atan2(x, z), select(less(x, z), y, t)};
  std::vector<Id> outputs;
  for (const Node& node : nodes) outputs.push_back(node.id_in(graph));
  expect_block_equals_particles(Program(graph, outputs), 1, 1, outputs.size(), Row<double>::of({2.5}));
}

TEST(Interpreter, FusesEachKindOfProductAndSum) {
  Graph graph;
  const Node x(graph, graph.input(Role::kState, 0));
  const Node z(graph, graph.input(Role::kNormal, 0));
  const Node y(graph, graph.input(Role::kColumn, 0));
  const std::vector<Node> nodes{x * z + y, x * y - z, y - z * z * x};
  std::vector<Id> outputs;
  for (const Node& node : nodes) outputs.push_back(node.id_in(graph));
  const Program program(graph, outputs);
  const auto fused =
      std::count_if(program.block_code().code.begin(), program.block_code().code.end(), [](const auto& i) {
        return i.fused == BlockCode::Fused::kPlus || i.fused == BlockCode::Fused::kMinus ||
               i.fused == BlockCode::Fused::kFrom;
      });
  EXPECT_EQ(fused, 3);
  expect_block_equals_particles(program, 1, 1, outputs.size(), Row<double>::of({2.5}));
}

TEST(Interpreter, CopiesOutputsThatNothingComputes) {
  Graph graph;
  const Id x = graph.input(Role::kState, 1);
  const Id y = graph.input(Role::kColumn, 0);
  const Id sum = graph.operation(Op::kAdd, {x, y});
  const std::array<Id, 5> outputs{x, y, graph.constant(4), sum, sum};
  expect_block_equals_particles(Program(graph, outputs), 2, 0, 5, Row<double>::of({2.5}));
}

}  // namespace
}  // namespace mote::graph

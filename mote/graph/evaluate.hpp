#pragma once
/// The arithmetic of a graph's operations in any number type.

#include <array>
#include <vector>

#include "mote/base/numbers.hpp"
#include "mote/graph/graph.hpp"

namespace mote::graph {

/// The result of an operation, in the arithmetic of S.
template <class S>
S apply(Op op, const std::array<S, 4>& v) {
  using namespace numbers;
  switch (op) {
    case Op::kAdd:
      return v[0] + v[1];
    case Op::kSubtract:
      return v[0] - v[1];
    case Op::kMultiply:
      return v[0] * v[1];
    case Op::kDivide:
      return v[0] / v[1];
    case Op::kNegate:
      return -v[0];
    case Op::kAbs:
      return abs(v[0]);
    case Op::kFloor:
      return floor(v[0]);
    case Op::kSqrt:
      return sqrt(v[0]);
    case Op::kExp:
      return exp(v[0]);
    case Op::kLog:
      return log(v[0]);
    case Op::kSin:
      return sin(v[0]);
    case Op::kCos:
      return cos(v[0]);
    case Op::kTan:
      return tan(v[0]);
    case Op::kAtan:
      return atan(v[0]);
    case Op::kAtan2:
      return atan2(v[0], v[1]);
    case Op::kSelect:
      return select(less(v[0], v[1]), v[2], v[3]);
    case Op::kConstant:
    case Op::kInput:
      break;
  }
  return v[0];
}

/// The value of every vertex; input(vertex) gives those of the inputs.
///
/// shape   values: (graph.size(),), written
/// cost    O(size)
template <class Input>
void evaluate(const Graph& graph, const Input& input, std::vector<double>& values) {
  values.resize(graph.size());
  std::array<double, 4> args{};
  for (Id id = 0; id < graph.size(); ++id) {
    const Vertex& v = graph[id];
    if (v.op == Op::kConstant) {
      values[id] = v.value;
    } else if (v.op == Op::kInput) {
      values[id] = input(v);
    } else {
      for (std::size_t k = 0; k < arity(v.op); ++k) args[k] = values[v.args[k]];
      values[id] = apply<double>(v.op, args);
    }
  }
}

}  // namespace mote::graph

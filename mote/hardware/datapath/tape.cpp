#include "mote/hardware/datapath/tape.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "mote/graph/evaluate.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Op;
using graph::Vertex;

/// Derivatives of an operation by its operands v, where its result is y.
std::array<double, 4> derivatives(Op op, const std::array<double, 4>& v, double y) {
  switch (op) {
    case Op::kAdd:
      return {1, 1};
    case Op::kSubtract:
      return {1, -1};
    case Op::kMultiply:
      return {v[1], v[0]};
    case Op::kDivide:
      return {1 / v[1], -y / v[1]};
    case Op::kNegate:
      return {-1};
    case Op::kAbs:
      return {v[0] < 0 ? -1.0 : 1.0};
    case Op::kSqrt:
      return {0.5 / y};
    case Op::kExp:
      return {y};
    case Op::kLog:
      return {1 / v[0]};
    case Op::kSin:
      return {std::cos(v[0])};
    case Op::kCos:
      return {-std::sin(v[0])};
    case Op::kTan:
      return {1 + y * y};
    case Op::kAtan:
      return {1 / (1 + v[0] * v[0])};
    case Op::kAtan2: {
      const double square = v[0] * v[0] + v[1] * v[1];
      return {v[1] / square, -v[0] / square};
    }
    case Op::kSelect:
      return v[0] < v[1] ? std::array<double, 4>{0, 0, 1, 0} : std::array<double, 4>{0, 0, 0, 1};
    case Op::kFloor:
    case Op::kConstant:
    case Op::kInput:
      break;
  }
  return {};
}

}  // namespace

Tape::Tape(const Plan& plan, const graph::Recorded& recorded, Part part)
    : graph_(plan.graph),
      order_(needed(plan.graph, plan.outputs(part))),
      source_(plan.graph.size(), static_cast<Id>(recorded.graph.size())),
      values_(plan.graph.size()),
      slopes_(plan.graph.size()) {
  std::map<std::pair<graph::Role, std::uint32_t>, Id> inputs;
  for (Id id = 0; id < recorded.graph.size(); ++id)
    if (const Vertex& v = recorded.graph[id]; v.op == Op::kInput) inputs[{v.role, v.index}] = id;
  for (const Id id : order_)
    if (const auto found = inputs.find({graph_[id].role, graph_[id].index}); found != inputs.end())
      source_[id] = found->second;
}

void Tape::evaluate(const Samples::Call& call) {
  std::array<double, 4> operands{};
  for (const Id id : order_) {
    const Vertex& v = graph_[id];
    if (v.op == Op::kConstant) {
      values_[id] = v.value;
    } else if (v.op == Op::kInput) {
      values_[id] = source_[id] < call.size() ? call[source_[id]] : 1;
    } else {
      for (std::size_t k = 0; k < graph::arity(v.op); ++k) operands[k] = values_[v.args[k]];
      values_[id] = graph::apply<double>(v.op, operands);
    }
  }
}

void Tape::differentiate(Id result) {
  for (const Id id : order_) slopes_[id] = 0;
  slopes_[result] = 1;
  std::array<double, 4> operands{};
  for (auto place = order_.rbegin(); place != order_.rend(); ++place) {
    const Vertex& v = graph_[*place];
    if (slopes_[*place] == 0) continue;
    for (std::size_t k = 0; k < graph::arity(v.op); ++k) operands[k] = values_[v.args[k]];
    const auto by = derivatives(v.op, operands, values_[*place]);
    for (std::size_t k = 0; k < graph::arity(v.op); ++k)
      if (by[k] != 0) slopes_[v.args[k]] += slopes_[*place] * by[k];
  }
}

}  // namespace mote::hardware

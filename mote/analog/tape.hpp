#pragma once
/// A tape: a function of a placement as its operations in their order, for a filter's inner loop.

#include <vector>

#include "mote/analog/arithmetic.hpp"

namespace mote::analog {

/// Where a function's inputs are read; what it does not read may be left out.
struct TapeInputs {
  const double* state = nullptr;     ///< kState
  const double* before = nullptr;    ///< kBefore
  const double* row = nullptr;       ///< kColumn
  const double* schedule = nullptr;  ///< kSchedule
  const double* draws = nullptr;     ///< the four roles of draws, by number

  double operator()(const graph::Vertex& input) const {
    switch (input.role) {
      case graph::Role::kState:
        return state[input.index];
      case graph::Role::kBefore:
        return before[input.index];
      case graph::Role::kColumn:
        return row[input.index];
      case graph::Role::kSchedule:
        return schedule[input.index];
      default:
        return draws[input.index];
    }
  }
};

/// Some vertices of a placement and all that they depend on. graph::Replayed does the same for arithmetics that want to
/// see every vertex; here constants are written once, and an exact operation is one case of one switch.
///
/// cost    about 3 ns an exact operation
class Tape {
 public:
  Tape(const Placement& placement, const MixedArithmetic& arithmetic, const std::vector<graph::Id>& outputs);

  /// Computes the outputs.
  ///
  /// shape   out: as many as outputs
  [[gnu::flatten]] void run(MixedArithmetic& arithmetic, const TapeInputs& inputs, double* out) {
    for (const auto& [id, vertex] : inputs_) values_[id] = arithmetic.number(id, inputs(vertex));
    for (const Step& step : steps_) {
      const std::array<double, 4> operands{values_[step.vertex.args[0]], values_[step.vertex.args[1]],
                                           values_[step.vertex.args[2]], values_[step.vertex.args[3]]};
      values_[step.id] = step.exact ? graph::apply<double>(step.vertex.op, operands)
                                    : arithmetic.compute(step.id, step.vertex, operands);
    }
    for (std::size_t k = 0; k < outputs_.size(); ++k) out[k] = values_[outputs_[k]];
  }

 private:
  struct Step {
    graph::Id id;
    bool exact;
    graph::Vertex vertex;
  };

  std::vector<std::pair<graph::Id, graph::Vertex>> inputs_;
  std::vector<Step> steps_;
  std::vector<graph::Id> outputs_;
  std::vector<double> values_;  ///< by vertex
};

inline Tape::Tape(const Placement& placement, const MixedArithmetic& arithmetic, const std::vector<graph::Id>& outputs)
    : outputs_(outputs), values_(placement.recorded.graph.size()) {
  const graph::Graph& graph = placement.recorded.graph;
  const std::vector<bool> used = graph::reached(graph, outputs);
  for (graph::Id id = 0; id < graph.size(); ++id) {
    if (!used[id]) continue;
    const graph::Vertex& v = graph[id];
    if (v.op == graph::Op::kConstant) {
      values_[id] = v.value;
    } else if (v.op == graph::Op::kInput) {
      inputs_.emplace_back(id, v);
    } else {
      steps_.push_back({id, arithmetic.is_exact(id), v});
    }
  }
}

}  // namespace mote::analog

#pragma once
/// A tape: functions of a graph as its operations in their order, for inner loops.

#include <array>
#include <vector>

#include "mote/graph/graph.hpp"

namespace mote::graph {

/// Some vertices of a graph and all that they depend on, for up to kWidth particles side by side: what a vertex asks
/// for is looked up once for all of them. An arithmetic computes:
///
///   take(id, vertex, column, count)              an input or a constant, of `count` particles
///   compute(id, vertex, operands, count, out)    an operation on columns
///
/// cost    with one particle about 3 ns an operation, a fifth of it side by side
template <class Number, std::size_t kWidth = 1>
class Tape {
 public:
  /// Where operands stand.
  using Columns = std::array<const Number*, 4>;

  Tape(const Graph& graph, const std::vector<Id>& outputs) : outputs_(outputs), values_(graph.size() * kWidth) {
    const std::vector<bool> used = reached(graph, outputs);
    for (Id id = 0; id < graph.size(); ++id)
      if (used[id]) steps_.push_back({id, arity(graph[id].op) > 0, graph[id]});
  }

  /// Computes the outputs of `count` particles.
  template <class Arithmetic>
  void run(Arithmetic&& arithmetic, std::size_t count = kWidth) {
    for (const Step& step : steps_) {
      Number* out = values_.data() + step.id * kWidth;
      const auto& args = step.vertex.args;
      if (step.computes)
        arithmetic.compute(step.id, step.vertex, Columns{at(args[0]), at(args[1]), at(args[2]), at(args[3])}, count,
                           out);
      else
        arithmetic.take(step.id, step.vertex, out, count);
    }
  }

  /// The last results of output k, a column.
  const Number* output(std::size_t k) const { return at(outputs_[k]); }
  std::size_t outputs() const { return outputs_.size(); }

  /// Calls visit(id) for each vertex, in their order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Step& step : steps_) visit(step.id);
  }

 private:
  struct Step {
    Id id;
    bool computes;
    Vertex vertex;
  };
  const Number* at(Id id) const { return values_.data() + id * kWidth; }

  std::vector<Id> outputs_;
  std::vector<Step> steps_;
  std::vector<Number> values_;  ///< by vertex and particle
};

}  // namespace mote::graph

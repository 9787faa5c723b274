#pragma once
/// A tape: a function of a placement as its operations in their order, for a filter's inner loop.

#include <algorithm>
#include <utility>
#include <vector>

#include "mote/analog/arithmetic.hpp"

namespace mote::analog {

/// Some vertices of a placement and all that they depend on, for up to `kWidth` particles side by side: an operation
/// is chosen once for all of them. graph::Replayed does the same, one by one, for arithmetics that want to see every
/// vertex.
///
/// cost    about 3 ns an operation of one particle by itself, a fifth of it side by side
template <std::size_t kWidth>
class Tape {
 public:
  Tape(const Placement& placement, const MixedArithmetic& arithmetic, const std::vector<graph::Id>& outputs);

  /// Normal numbers that a particle takes as noise.
  std::size_t normals() const { return normals_; }

  /// Computes the outputs of `count` particles. `fill(vertex, column)` writes an input's value of each of them.
  ///
  /// shape   noise: normal number k of particle i at noise[k kWidth + i], or nullptr for none
  template <class Fill>
  [[gnu::flatten]] void run(MixedArithmetic& arithmetic, const Fill& fill, const double* noise, std::size_t count) {
    const std::size_t width = kWidth == 1 ? 1 : count;
    for (const auto& [id, vertex] : inputs_) {
      double* column = values_.data() + id * kWidth;
      fill(vertex, column);
      arithmetic.take(id, column, width);
    }
    for (const Step& step : steps_) {
      const Columns operands{column(step.vertex.args[0]), column(step.vertex.args[1]), column(step.vertex.args[2]),
                             column(step.vertex.args[3])};
      double* out = values_.data() + step.id * kWidth;
      if (!step.graphs) {
        const double* normals = noise == nullptr ? nullptr : noise + step.first_normal * kWidth;
        arithmetic.compute(step.id, step.vertex, operands, {normals, kWidth}, width, out);
      } else if constexpr (kWidth == 1) {
        *out =
            step.gain * graph::apply<double>(step.vertex.op, {*operands[0], *operands[1], *operands[2], *operands[3]});
      } else {
        apply_all(step.vertex.op, operands, step.gain, width, out);
      }
    }
  }

  /// The last results of output k.
  const double* output(std::size_t k) const { return column(outputs_[k]); }

 private:
  struct Step {
    graph::Id id;
    bool graphs;
    double gain;
    std::size_t first_normal;
    graph::Vertex vertex;
  };
  const double* column(graph::Id id) const { return values_.data() + id * kWidth; }

  std::vector<std::pair<graph::Id, graph::Vertex>> inputs_;
  std::vector<Step> steps_;
  std::vector<graph::Id> outputs_;
  std::vector<double> values_;  ///< by vertex and particle
  std::size_t normals_ = 0;
};

template <std::size_t kWidth>
Tape<kWidth>::Tape(const Placement& placement, const MixedArithmetic& arithmetic, const std::vector<graph::Id>& outputs)
    : outputs_(outputs), values_(placement.recorded.graph.size() * kWidth) {
  const graph::Graph& graph = placement.recorded.graph;
  const std::vector<bool> used = graph::reached(graph, outputs);
  for (graph::Id id = 0; id < graph.size(); ++id) {
    if (!used[id]) continue;
    const graph::Vertex& v = graph[id];
    if (v.op == graph::Op::kConstant) {
      std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(id * kWidth), kWidth, v.value);
    } else if (v.op == graph::Op::kInput) {
      inputs_.emplace_back(id, v);
    } else {
      steps_.push_back({id, arithmetic.is_graphs(id), arithmetic.gain(id), normals_, v});
      normals_ += arithmetic.normals(id);
    }
  }
}

}  // namespace mote::analog

#pragma once
/// What a filter's particles were: the inputs of a recorded model's functions, from which ranges and precisions come.

#include <array>
#include <vector>

#include "mote/graph/evaluate.hpp"
#include "mote/graph/record.hpp"

namespace mote::hardware {

/// A function of a recorded model.
enum class Part : std::uint8_t { kInitial, kNext, kWeigh };
inline constexpr std::array<Part, 3> kParts{Part::kInitial, Part::kNext, Part::kWeigh};

/// Inputs of a model's functions as a filter in double called them.
struct Samples {
  /// The inputs of one call, by vertex: (graph.size(),); numbers elsewhere are of no meaning.
  using Call = std::vector<double>;

  std::array<std::vector<Call>, 3> calls;  ///< by Part
  std::vector<double> errors;              ///< by state: root mean square error of the filter's mean, 0 unknown

  const std::vector<Call>& of(Part part) const { return calls[static_cast<std::size_t>(part)]; }
};

/// Double, and every so-many-th call of each function kept: an arithmetic for graph::Replayed.
class SampledArithmetic {
 public:
  using Number = double;

  /// shape   one call in `stride` is kept, the first among them, `most` of each function
  explicit SampledArithmetic(const graph::Recorded& recorded, std::size_t stride = 61, std::size_t most = 4096);

  double number(graph::Id id, double value) { return put(id, value); }
  static double value(graph::Id, double number) { return number; }
  double compute(graph::Id id, const graph::Vertex& vertex, const std::array<double, 4>& operands) {
    return put(id, graph::apply<double>(vertex.op, operands));
  }
  const Samples& samples() const { return samples_; }

 private:
  double put(graph::Id id, double value) {
    values_[id] = value;
    for (std::size_t part = 0; part < last_.size(); ++part)
      if (id == last_[part]) end_of(part);
    return value;
  }
  void end_of(std::size_t part);

  std::vector<double> values_;
  std::array<graph::Id, 3> last_{};  ///< the vertex that a function computes last
  std::array<std::size_t, 3> count_{};
  std::size_t stride_, most_;
  Samples samples_;
};

}  // namespace mote::hardware

#pragma once
/// Fixed-point arithmetic of a graph, bit for bit what a circuit of the same formats computes.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "mote/graph/format.hpp"

namespace mote::graph {

/// An operation on numbers of given formats.
struct FixedOperation {
  Op op = Op::kAdd;
  Format out;
  std::array<Format, 4> in{};
  Rounding rounding = Rounding::kNearest;
};

/// The integer twin of an operator: operands in, result out, in their formats.
using Twin = std::int64_t (*)(const FixedOperation& operation, const std::array<std::int64_t, 4>& raw);

/// A twin for every operation: what a room of circuits replaces by those of its own operators.
struct Twins {
  std::string_view name;
  std::array<Twin, 18> by_op;  ///< by the number of an Op
};

/// Sums, products, negation, absolute value, floor and selection exactly, then rounded once; the other operations in
/// double, then rounded: correctly but where double's own error decides on a tie.
///
/// error   half a unit in the last place (kNearest), one below (kTruncate); saturates at the ends of the range
const Twins& rounded_double_twins();

/// The formats of a graph's vertices and how they are computed in.
struct FixedPoint {
  std::vector<Format> formats;  ///< (graph.size(),)
  Rounding rounding = Rounding::kNearest;
  const Twins* twins = &rounded_double_twins();
};

/// A fixed-point number that a graph's vertex takes.
class FixedArithmetic {
 public:
  using Number = std::int64_t;

  FixedArithmetic(const Graph& graph, FixedPoint point);

  Number number(Id id, double value) const { return to_fixed(value, point_.formats[id], Rounding::kNearest); }
  double value(Id id, Number raw) const { return point_.formats[id].value(raw); }
  Number compute(Id id, const Vertex& vertex, const std::array<Number, 4>& operands) const {
    return point_.twins->by_op[static_cast<std::size_t>(vertex.op)](operations_[id], operands);
  }

 private:
  FixedPoint point_;
  std::vector<FixedOperation> operations_;
};

}  // namespace mote::graph

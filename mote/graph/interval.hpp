#pragma once
/// Interval analysis: between which bounds every vertex of a graph lies, given those of its inputs.

#include <functional>
#include <vector>

#include "mote/base/numbers.hpp"
#include "mote/graph/graph.hpp"

namespace mote::graph {

/// The numbers from low to high, both included.
struct Interval {
  double low = -kInfinity, high = kInfinity;

  bool contains(double value) const { return low <= value && value <= high; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// The numbers in both; `a` where there are none.
Interval intersection(const Interval& a, const Interval& b);

/// Bounds of every vertex, from those of the inputs. An operand that occurs twice is taken for two numbers, but in a
/// square: bounds are safe, not tight.
///
///   [a] op [b] contains x op y for all x in [a], y in [b]
///
/// shape   (graph.size(),)
/// error   none; rounding of the bounds themselves is not accounted for
/// cost    O(size)
/// source  Moore, Kearfott & Cloud 2009, ch. 2, 5
std::vector<Interval> intervals(const Graph& graph, const std::function<Interval(const Vertex&)>& input);

}  // namespace mote::graph

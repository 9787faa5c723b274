#pragma once
/// Simplification: the same numbers from fewer operations.

#include <span>
#include <vector>

#include "mote/graph/graph.hpp"

namespace mote::graph {

/// Which identities may be used.
enum class Identities : std::uint8_t {
  kExact,     ///< results keep every bit, but for the sign of a zero
  kRounding,  ///< also x / c = x (1 / c), which rounds once more: error below 1.5 ulp instead of 0.5
};

/// A graph and the outputs taken from it.
struct Outputs {
  Graph graph;
  std::vector<Id> ids;
};

/// The outputs, with what they do not depend on left out, operations on constants done, equal vertices merged, and
///
///   x + 0 = x,  x + (-y) = x - y,  x - (-y) = x + y,  0 - x = -x,  -(x - y) = y - x,  -(-x) = x
///   x 1 = x,  x (-1) = -x,  (-x) (-y) = x y,  (-x) c = x (-c),  x / c = x (1 / c) for c a power of two
///   |-x| = |x|,  |x x| = x x,  floor(floor x) = floor x,  a < b ? c : c = c
///
/// applied; x + y and x y have their operands in the order of the vertices' numbers.
///
/// error   none
/// cost    O(size)
Outputs simplified(const Graph& graph, std::span<const Id> outputs, Identities identities = Identities::kExact);

}  // namespace mote::graph

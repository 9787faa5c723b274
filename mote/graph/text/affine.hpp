#pragma once
/// Right-hand sides that are f + sd z: where a transition density can be read off.

#include <optional>
#include <vector>

#include "mote/graph/node.hpp"

namespace mote::graph {

/// rest + factor z, z a normal number.
struct Affine {
  Node rest, factor;
};

/// Each expression as rest + factor z with a normal number z of its own; nothing if one is not of that form, or has a
/// factor of zero.
///
/// cost    O(size); adds rests and factors to the graph
std::optional<std::vector<Affine>> affine_in_own_noise(Graph& graph, const std::vector<Node>& expressions);

}  // namespace mote::graph

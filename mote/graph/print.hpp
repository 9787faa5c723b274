#pragma once
/// Graphs for readers: as lines of text, and for Graphviz.

#include <string>

#include "mote/graph/record.hpp"

namespace mote::graph {

/// One line a vertex, "v7 = multiply v3 v6", then one an output, "next x = v9".
std::string as_text(const Recorded& recorded);

/// The same as a digraph in Graphviz's language: `dot -Tsvg`.
std::string as_dot(const Recorded& recorded);

}  // namespace mote::graph

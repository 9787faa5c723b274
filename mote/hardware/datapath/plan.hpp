#pragma once
/// A model in the form in which hardware computes it.

#include <span>
#include <vector>

#include "mote/graph/record.hpp"
#include "mote/hardware/datapath/samples.hpp"

namespace mote::hardware {

/// A recorded model made ready for hardware: a graph of its own.
///
///   log2 p(y | x) = constant + log_weight,   log_weight = sum of groups,  group = c sum_k [k seen] term_k
///
/// A recorded proposal takes the place of the model's move, and log2 p(x | before) / g(x | before, y) is added to the
/// weight, where all observations are seen. Terms that the state does not enter are left out. Numbers that depend on
/// the row and on t alone are computed by the host, once a step: `fields`.
struct Plan {
  graph::Graph graph;
  std::vector<graph::Id> initial, next;          ///< (D,)
  graph::Id log_weight = 0;                      ///< octaves
  std::vector<graph::Id> fields;                 ///< vertices of the host that particles meet, and the bits "seen"
  std::vector<std::vector<std::uint32_t>> seen;  ///< by bit: the columns that were all seen; see seen_bit
  std::uint32_t columns = 0;                     ///< of the model; kColumn inputs from there on are bits
  double constant = 0;                           ///< octaves

  /// The number of the bit that an input is, or -1.
  int seen_bit(graph::Id id) const;
  /// What a part computes.
  std::vector<graph::Id> outputs(Part part) const;
};

Plan plan_of(const graph::Recorded& recorded);

/// Whether each vertex depends on the row and on t alone, and is no constant.
std::vector<bool> of_the_host(const graph::Graph& graph);

/// The vertices that outputs depend on, in order.
std::vector<graph::Id> needed(const graph::Graph& graph, std::span<const graph::Id> outputs);

}  // namespace mote::hardware

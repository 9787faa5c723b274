#pragma once
/// The random numbers of a recorded function.

#include <vector>

#include "mote/model/model.hpp"

namespace mote::graph {

/// Draws a number for each entry: a standard normal one where it is true, else one uniform on (0, 1).
template <class S, class D>
SmallVector<S> drawn(const std::vector<bool>& normal, D& draw) {
  SmallVector<S> all;
  for (const bool is_normal : normal) all.push_back(S(is_normal ? draw.normal() : draw.uniform()));
  return all;
}

}  // namespace mote::graph

#pragma once
/// Draws without chance: every number at its median.

#include <algorithm>
#include <cstddef>

#include "mote/model/model.hpp"

namespace mote {

/// What a model may be handed as `draw` to move without noise; counts what it takes.
template <class S>
struct StillDraw {
  std::size_t normals = 0, uniforms = 0;

  S normal() {
    ++normals;
    return S(0);
  }
  S uniform() {
    ++uniforms;
    return S(0.5);
  }
  std::size_t taken() const { return normals + uniforms; }
};

/// Coordinates that a model's step takes of a point: the numbers it draws, at t = 0 or later.
template <Model M>
std::size_t point_dimensions(const M& model) {
  StillDraw<double> prior;
  const auto x = model.template initial<double>(prior);
  StillDraw<double> moved;
  model.template next<double>(1, x, moved);
  return std::max(prior.taken(), moved.taken());
}

}  // namespace mote

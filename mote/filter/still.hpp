#pragma once
/// Draws without chance: every number at its median.

#include <cstddef>

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

}  // namespace mote

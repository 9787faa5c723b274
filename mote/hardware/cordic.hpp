#pragma once
/// Rotations by shifts and additions: the golden twin of mote_cordic.

#include <vector>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// One chain of rotations: circular (angles atan 2^-k), linear (2^-k) or hyperbolic (atanh 2^-k).
///
/// rotation    (x, y, z) -> K (x cos z - y sin z, y cos z + x sin z), z -> 0        (circular; cosh, sinh and + when
/// hyperbolic) vectoring   (x, y, z) -> (K sqrt(x^2 + y^2), 0, z + atan(y / x)), x > 0          (circular; sqrt(x^2 -
/// y^2), atanh; z + y / x when linear) error       each stage rounds x and y down by up to a step of theirs; the angle
/// left over is below the last stage's source      Walther 1971, "A unified algorithm for elementary functions"; stages
/// 4, 13 and 40 are taken twice when hyperbolic
class Cordic {
 public:
  enum class Mode : int { kCircular = 0, kLinear = 1, kHyperbolic = 2 };

  /// shape   the last shift is `last`; x and y: `width` signed bits; z: signed format, in units of `angle_unit`
  Cordic(Mode mode, bool vectoring, int last, int width, const Format& z, double angle_unit = 1);

  void compute(Columns in, Results out) const;
  Circuit circuit() const;

  /// K: what the length of (x, y) grows by.
  double gain() const;

 private:
  Mode mode_;
  bool vectoring_;
  int width_;
  Format z_;
  std::vector<int> shifts_;
  std::vector<Word> angles_;
};

}  // namespace mote::hardware

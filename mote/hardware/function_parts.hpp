#pragma once
/// What the functions of functions.hpp share.

#include <string>
#include <vector>

#include "mote/hardware/cordic.hpp"
#include "mote/hardware/functions.hpp"
#include "mote/hardware/sketch.hpp"

namespace mote::hardware {

/// "mote_log_u4_12_s3_12_cordic": a name that says everything that the module depends on.
std::string function_name(const std::string& function, const std::vector<Format>& formats,
                          const FunctionOptions& options);

/// A number as mantissa in [1, 2) (0 for 0) and the place of its leading one.
struct Floating {
  Signal mantissa;  ///< u1.(width - 1)
  Signal place;
  Signal other;  ///< the other word, shifted by as many places, in units of the mantissa
  int width;
};

/// Normalises an unsigned signal; `also` of the same format is shifted along.
Floating floating(Sketch& sketch, const Signal& x, const Signal& also);
Floating floating(Sketch& sketch, const Signal& x);

/// 1 / m for a mantissa m in [1, 2), in (1/2, 1], with an error of a step; 0 is taken for 1.
Signal reciprocal_of_mantissa(Sketch& sketch, const Signal& mantissa, int fraction, Form form);

/// What a chain of rotations gives.
struct Rotated {
  Signal x, y, z;
};

/// Rotations of (x, y, z) with results good to 2^-fraction: four more bits inside, x and y of `integer` bits before the
/// point.
struct Rotation {
  Cordic::Mode mode;
  bool vectoring;
  int fraction;
  int integer;
  double angle_unit = 1;

  int inner_fraction() const { return fraction + 4; }
  Format xy() const { return {true, integer, inner_fraction()}; }
  Format angle() const { return {true, 2, inner_fraction()}; }
  Cordic cordic() const { return {mode, vectoring, fraction + 2, xy().width(), angle(), angle_unit}; }
  Rotated of(Sketch& sketch, const Signal& x, const Signal& y, const Signal& z) const;
};

/// The two coordinates of a point on a circle.
struct Pair {
  Signal cosine, sine;
};

/// A point turned by 0 to 3 quarters of the circle, in the format y.
Pair turned_by_quarters(Sketch& sketch, const Pair& pair, const Signal& quarter, const Format& y);

}  // namespace mote::hardware

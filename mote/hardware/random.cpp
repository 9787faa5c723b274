#include "mote/hardware/random.hpp"

#include <cmath>

#include "mote/base/normal.hpp"
#include "mote/base/numbers.hpp"
#include "mote/hardware/function_parts.hpp"

namespace mote::hardware {

double normal_of(double x) { return -standard_normal_quantile(x / 2 + 0x1p-33); }

Piecewise normal_unit(int fraction, Multiplier multiplier) {
  return fit_piecewise(normal_of, kSignedBits, {true, 3, fraction}, Fold::kMirrored, 0, {1.0, 2, multiplier});
}

double radius_of(double x) { return std::sqrt(-2 * (x >= 0 ? std::log(x / 2 + 0x1p-33) : std::log1p(x / 2))); }

Compound box_muller(int fraction, Multiplier multiplier) {
  const Format z{true, 3, fraction};
  Sketch sketch(function_name("box_muller", {z}, {Form::kCordic, multiplier}), multiplier);
  const Signal radius_word = sketch.input("u_i", kSignedBits);
  const Signal angle_word = sketch.input("v_i", kPlainBits);
  const Rotation rotation{Cordic::Mode::kCircular, false, fraction + 4, 3,
                          kPi / 2};  // radii up to 7 make angles matter more
  // the rotation's gain is taken away by the table
  const double gain = rotation.cordic().gain();
  const Signal radius = sketch.table([gain](double x) { return radius_of(x) / gain; }, radius_word,
                                     {false, 3, fraction + 3}, Fold::kSides);
  const Signal place = sketch.bits(angle_word, 0, 30, 30);
  const Signal centred = sketch.difference(place, sketch.constant(rotation.angle(), 0.5), rotation.angle());
  const Rotated rotated = rotation.of(sketch, radius, sketch.constant(rotation.xy(), 0), centred);
  const Pair both = turned_by_quarters(sketch, {rotated.x, rotated.y}, sketch.bits(angle_word, 30, 2), z);
  sketch.output("z0_o", both.cosine);
  sketch.output("z1_o", both.sine);
  return sketch.done();
}

}  // namespace mote::hardware

#include <cmath>

#include "mote/base/numbers.hpp"
#include "mote/hardware/function_parts.hpp"
#include "mote/hardware/shift.hpp"

namespace mote::hardware {
namespace {

/// Cosine and sine of (place - 1/2) quarter turns, place in [0, 1).
Pair in_the_quarter(Sketch& sketch, const Signal& place, int fraction, Form form) {
  const Format result{true, 1, fraction};
  const auto angle = [](double p) { return (p - 0.5) * kPi / 2; };
  if (form == Form::kTable)
    return {sketch.table([angle](double p) { return std::cos(angle(p)); }, place, result),
            sketch.table([angle](double p) { return std::sin(angle(p)); }, place, result)};
  const Rotation rotation{Cordic::Mode::kCircular, false, fraction, 1, kPi / 2};
  const Signal centred = sketch.difference(place, sketch.constant(rotation.angle(), 0.5), rotation.angle());
  const Rotated rotated = rotation.of(sketch, sketch.constant(rotation.xy(), 1 / rotation.cordic().gain()),
                                      sketch.constant(rotation.xy(), 0), centred);
  return {sketch.convert(rotated.x, result), sketch.convert(rotated.y, result)};
}

/// The angle in [0, pi/4] of a point with 0 <= minor <= major.
Signal in_the_octant(Sketch& sketch, const Signal& major, const Signal& minor, int fraction, Form form) {
  const Floating point = floating(sketch, major, minor);
  const Format angle{false, 0, fraction};
  if (form == Form::kCordic) {
    const Rotation rotation{Cordic::Mode::kCircular, true, fraction, 3};
    const Signal zero = sketch.constant(rotation.angle(), 0);
    const Signal turned = sketch.convert(rotation.of(sketch, point.mantissa, point.other, zero).z, angle);
    return sketch.select(sketch.bits(point.mantissa, point.width - 1, 1), turned, sketch.constant(angle, 0));
  }
  const Signal inverse = reciprocal_of_mantissa(sketch, point.mantissa, fraction + 2, form);
  const Signal ratio = sketch.product(point.other, inverse, {false, 0, fraction + 2});
  return sketch.table([](double r) { return std::atan(r); }, ratio, angle);
}

/// The angle of the point (a, b).
Compound angle_of(Sketch& sketch, const Signal& a, const Signal& b, const Format& y, Form form) {
  const int fraction = y.fraction + 3;
  const Format inner{true, 2, fraction};
  const Signal left = sketch.sign(a);
  const Signal below = sketch.sign(b);
  const Signal across = sketch.magnitude(a, left);
  const Signal up = sketch.magnitude(b, below);
  const Signal angle =
      in_the_octant(sketch, sketch.extremum(across, up, true), sketch.extremum(across, up, false), fraction, form);
  const Signal steep = sketch.difference(sketch.constant(inner, kPi / 2), angle, inner);
  const Signal quarter = sketch.select(sketch.less(across, up), steep, sketch.convert(angle, inner));
  const Signal beyond = sketch.difference(sketch.constant(inner, kPi), quarter, inner);
  const Signal half = sketch.select(left, beyond, quarter);
  sketch.output("y_o", sketch.negate_if(below, sketch.convert(half, y), y));
  return sketch.done();
}

/// A number of half turns as the place in the first quarter of one, cut to what a result of y's fraction can tell.
Signal place_in_the_quarter(Sketch& sketch, const Signal& angle, const Format& y) {
  return sketch.convert(angle, {false, -2, y.fraction + 6}, {Rounding::kDown, Overflow::kSaturate});
}

/// The tangent of an angle of up to a quarter of half a turn.
Signal below_the_eighth(Sketch& sketch, const Signal& angle, const Format& y) {
  return sketch.table([](double h) { return std::tan(kPi * h); }, place_in_the_quarter(sketch, angle, y),
                      {false, 0, y.fraction + 3});
}

/// The cotangent of d half turns, d up to a quarter, as the reciprocal of d times d cot(pi d), which is smooth.
Signal towards_the_pole(Sketch& sketch, const Signal& left, const Format& y, Form form) {
  const int fraction = y.integer + y.fraction + 6;  // of factors, so that the product is good to the last bit of y
  const Signal slope = sketch.table([](double d) { return d == 0 ? 1 / kPi : d / std::tan(kPi * d); },
                                    place_in_the_quarter(sketch, left, y), {false, 0, fraction});
  const Floating distance = floating(sketch, left);
  const Format leading{false, 1, std::min(distance.mantissa.format.fraction, fraction)};
  const Signal mantissa = sketch.convert(distance.mantissa, leading, {Rounding::kDown, Overflow::kSaturate});
  const Signal inverse = reciprocal_of_mantissa(sketch, mantissa, fraction - 1, form);
  const Signal quotient = sketch.product(slope, inverse, {false, 0, fraction}).times_two_to(left.format.fraction);
  return sketch.op(Scale{quotient.format, distance.place.format.width(), y}, y, quotient, distance.place);
}

}  // namespace

Pair turned_by_quarters(Sketch& sketch, const Pair& pair, const Signal& quarter, const Format& y) {
  const Signal swap = sketch.bits(quarter, 0, 1);
  const Signal down = sketch.bits(quarter, 1, 1);
  const Signal left = sketch.bits(sketch.sum(quarter, sketch.constant({false, 1, 0}, 1), {false, 3, 0}), 1, 1);
  const Signal first = sketch.select(swap, pair.sine, pair.cosine);
  const Signal second = sketch.select(swap, pair.cosine, pair.sine);
  return {sketch.negate_if(left, sketch.convert(first, y), y), sketch.negate_if(down, sketch.convert(second, y), y)};
}

Compound cosine_and_sine(const Format& x, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("cosine_and_sine", {x, y}, options), options.multiplier, options.interval);
  const int fraction = y.fraction + 2;
  // the phase in turns and an eighth, so that its first two bits are the quarter and the others the place in it
  const Format turn{false, 0, fraction + 3};
  const Signal phase =
      sketch.scaled(sketch.input("x_i", x), 1 / (2 * kPi), fraction + 5 + x.integer, turn, Overflow::kWrap);
  const Sum eighth{turn, turn, turn, false, {Rounding::kDown, Overflow::kWrap}};
  const Signal ahead = sketch.op(eighth, turn, phase, sketch.constant(turn, 0.125));
  const Signal place = sketch.bits(ahead, 0, fraction + 1, fraction + 1);
  const Signal quarter = sketch.bits(ahead, fraction + 1, 2);
  const Pair whole = turned_by_quarters(sketch, in_the_quarter(sketch, place, fraction, options.form), quarter, y);
  sketch.output("cos_o", whole.cosine);
  sketch.output("sin_o", whole.sine);
  return sketch.done();
}

Compound tangent(const Format& x, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("tangent", {x, y}, options), options.multiplier, options.interval);
  const Signal in = sketch.input("x_i", x);
  // d tan = (1 + tan^2) dx: what the angle has to be good to, where the tangent is as large as y holds
  const int fine = 2 * y.integer + y.fraction + 4;
  if (options.form == Form::kCordic) {
    const Format unit{true, 1, fine};
    const Signal cosine = sketch.op(cosine_and_sine(x, unit, options), unit, in);
    const Signal sine{{cosine.wire.node, 1}, unit};
    sketch.output("y_o", sketch.op(divide(unit, unit, y, options), y, sine, cosine));
    return sketch.done();
  }
  // in half turns, of which whole ones fall off: the angle closest to 0, and what is left to the pole
  const Signal closest = sketch.scaled(in, 1 / kPi, fine + 1 + x.integer, {true, -1, fine}, Overflow::kWrap);
  const Signal negative = sketch.sign(closest);
  const Signal angle = sketch.magnitude(closest, negative);
  const Signal left = sketch.difference(sketch.constant(angle.format, 0.5), angle, angle.format);
  const Format magnitude{false, y.integer, y.fraction};
  const Signal inner = sketch.convert(below_the_eighth(sketch, angle, y), magnitude);
  const Signal is_inner = sketch.less(angle, sketch.constant(angle.format, 0.25));
  const Signal size = sketch.select(is_inner, inner, towards_the_pole(sketch, left, magnitude, options.form));
  sketch.output("y_o", sketch.negate_if(negative, size, y));
  return sketch.done();
}

Compound arc_tangent_2(const Format& point, int fraction, const FunctionOptions& options) {
  const Format y{true, 2, fraction};
  Sketch sketch(function_name("arc_tangent_2", {point, y}, options), options.multiplier, options.interval);
  const Signal b = sketch.input("b_i", point);
  const Signal a = sketch.input("a_i", point);
  return angle_of(sketch, a, b, y, options.form);
}

Compound arc_tangent(const Format& x, int fraction, const FunctionOptions& options) {
  const Format y{true, 1, fraction};
  Sketch sketch(function_name("arc_tangent", {x, y}, options), options.multiplier, options.interval);
  const Signal in = sketch.input("x_i", x);
  if (options.form == Form::kTable) {
    sketch.output("y_o",
                  sketch.table([](double v) { return std::atan(v); }, in, y, x.sign ? Fold::kOdd : Fold::kPlain));
    return sketch.done();
  }
  const Format both{true, std::max(x.integer, 1), x.fraction};
  return angle_of(sketch, sketch.constant(both, 1), sketch.convert(in, both), y, options.form);
}

Compound wrapped_angle(const Format& x) {
  Sketch sketch(function_name("wrapped_angle", {x}, {}), Multiplier::kDsp);
  const Signal in = sketch.input("x_i", x);
  const Format count{true, std::max(1, x.integer - 2), 0};
  const Signal turns = sketch.scaled(in, 1 / (2 * kPi), x.width() + 2, count);
  const Format full{true, x.integer + 1, x.fraction + 3};
  const Signal whole = sketch.scaled(turns, 2 * kPi, x.width() + 4, full);
  sketch.output("y_o", sketch.difference(in, whole, {true, 2, x.fraction}));
  return sketch.done();
}

}  // namespace mote::hardware

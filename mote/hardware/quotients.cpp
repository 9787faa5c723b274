#include <algorithm>
#include <cmath>

#include "mote/hardware/function_parts.hpp"
#include "mote/hardware/shift.hpp"

namespace mote::hardware {
namespace {

/// The magnitude of a result: its integer and fraction bits, unsigned.
Format unsigned_part(const Format& y) { return {false, y.integer, y.fraction}; }

/// Bits after the point with which a quotient in (1/2, 2) must be known, its greatest multiple being 2^most.
int quotient_fraction(const Format& y, int most) { return std::max(4, std::min(y.integer, most) + y.fraction + 2); }

/// A shift by more places than any result has is as good as one by so many.
Format shift_format(int most) { return {false, ceil_log2(static_cast<std::uint64_t>(most) + 1), 0}; }

Compound signed_quotient(Sketch& sketch, const Signal& quotient, const Signal& shift, const Signal& negative,
                         const Format& y) {
  const Format magnitude = unsigned_part(y);
  const Signal size = sketch.op(Scale{quotient.format, shift.format.width(), magnitude}, magnitude, quotient, shift);
  sketch.output("y_o", y.sign ? sketch.negate_if(negative, size, y) : size);
  return sketch.done();
}

}  // namespace

Compound reciprocal(const Format& x, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("reciprocal", {x, y}, options), options.multiplier, options.interval);
  const Signal in = sketch.input("x_i", x);
  const Signal negative = sketch.sign(in);
  const Floating number = floating(sketch, sketch.magnitude(in, negative));
  // x = mantissa 2^(place - fraction)
  const int fraction = quotient_fraction(y, x.fraction + 1);
  const Signal inverse = reciprocal_of_mantissa(sketch, number.mantissa, fraction, options.form);
  return signed_quotient(sketch, inverse.times_two_to(x.fraction), number.place, negative, y);
}

Compound divide(const Format& a, const Format& b, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("divide", {a, b, y}, options), options.multiplier, options.interval);
  const Signal dividend = sketch.input("a_i", a);
  const Signal divisor = sketch.input("b_i", b);
  const Signal a_negative = sketch.sign(dividend);
  const Signal b_negative = sketch.sign(divisor);
  const Floating over = floating(sketch, sketch.magnitude(dividend, a_negative));
  const Floating under = floating(sketch, sketch.magnitude(divisor, b_negative));
  const int most = over.width + b.fraction - a.fraction;  // the greatest quotient is below 2^most
  const int fraction = quotient_fraction(y, most) + 1;
  const Format ratio{false, 1, fraction};
  Signal quotient{};
  if (options.form == Form::kCordic) {
    const Rotation rotation{Cordic::Mode::kLinear, true, fraction, 2};
    const Signal zero = sketch.constant(rotation.angle(), 0);
    // a divisor 0 has mantissa 0 and is taken for 1
    const Signal one = sketch.constant(under.mantissa.format, 1);
    const Signal is_there = sketch.bits(under.mantissa, under.width - 1, 1);
    const Signal mantissa = sketch.select(is_there, under.mantissa, one);
    quotient = sketch.convert(rotation.of(sketch, mantissa, over.mantissa, zero).z, ratio);
  } else {
    const Signal inverse = reciprocal_of_mantissa(sketch, under.mantissa, fraction + 1, options.form);
    quotient = sketch.product(sketch.convert(over.mantissa, {false, 1, std::min(over.width - 1, fraction + 2)}),
                              inverse, ratio);
  }
  // a / b = quotient 2^(place of a - place of b - fraction of a + fraction of b)
  const Format places{true, 7, 0};
  const Signal start = sketch.constant(places, over.width - 1);
  const Signal shift =
      sketch.sum(sketch.difference(start, over.place, places), under.place, shift_format(over.width + under.width));
  const Signal negative = sketch.bits(sketch.sum(a_negative, b_negative, {false, 2, 0}), 0, 1);
  return signed_quotient(sketch, quotient.times_two_to(over.width - 1 - a.fraction + b.fraction), shift, negative, y);
}

Compound square_root(const Format& x, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("square_root", {x, y}, options), options.multiplier, options.interval);
  // an even number of bits on either side of the point; x = v 2^integer 4^-pairs with v in [1/4, 1)
  const int fraction = x.fraction + (x.fraction & 1);
  const int integer = x.integer + (x.integer & 1);
  const Signal even = sketch.convert(sketch.input("x_i", x), {false, integer, fraction});
  const Normalise normalise{integer + fraction, true};
  const Signal pairs = sketch.op(normalise, {false, normalise.e_width(), 0}, even, sketch.constant(even.format, 0));
  const Signal v{{pairs.wire.node, 1}, {false, 0, integer + fraction}};
  const int places = std::max(4, std::min(y.integer, integer / 2) + y.fraction + 2);
  const Format result{false, 0, places};
  Signal root{};
  if (options.form == Form::kCordic) {
    const Rotation rotation{Cordic::Mode::kHyperbolic, true, places, 1};
    const Signal quarter = sketch.constant(rotation.xy(), 0.25);
    const Signal wide = sketch.convert(v, rotation.xy());
    const Rotated rotated =
        rotation.of(sketch, sketch.sum(wide, quarter, rotation.xy()), sketch.difference(wide, quarter, rotation.xy()),
                    sketch.constant(rotation.angle(), 0));
    const Signal any = sketch.scaled(rotated.x, 1 / rotation.cordic().gain(), places + 3, result);
    root = sketch.select(sketch.less(v, sketch.constant(v.format, 0.25)), sketch.constant(result, 0), any);
  } else {
    // below 1/4 there is only 0: a line through it spares a table of what does not come
    root = sketch.table([](double u) { return u < 0.25 ? 2 * u : std::sqrt(u); }, v, result);
  }
  sketch.output("y_o", sketch.op(Scale{root.times_two_to(integer / 2).format, normalise.e_width(), y}, y,
                                 root.times_two_to(integer / 2), pairs));
  return sketch.done();
}

}  // namespace mote::hardware

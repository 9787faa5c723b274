#include <algorithm>
#include <cmath>
#include <numbers>

#include "mote/hardware/function_parts.hpp"
#include "mote/hardware/shift.hpp"

namespace mote::hardware {

Compound logarithm(const Format& x, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("logarithm", {x, y}, options), options.multiplier, options.interval);
  const Floating number = floating(sketch, sketch.input("x_i", x));
  const int fraction = y.fraction + 3;
  const Format part{true, 6, fraction};
  Signal of_mantissa{};
  if (options.form == Form::kCordic) {
    // log m = 2 atanh((m - 1) / (m + 1)); an argument 0 has mantissa 0 and is taken for 1
    const Rotation rotation{Cordic::Mode::kHyperbolic, true, fraction, 2};
    const Signal one = sketch.constant(rotation.xy(), 1);
    const Signal mantissa = sketch.convert(number.mantissa, rotation.xy());
    const Rotated rotated =
        rotation.of(sketch, sketch.sum(mantissa, one, rotation.xy()), sketch.difference(mantissa, one, rotation.xy()),
                    sketch.constant(rotation.angle(), 0));
    const Signal is_there = sketch.bits(number.mantissa, number.width - 1, 1);
    of_mantissa = sketch.select(is_there, sketch.convert(rotated.z.times_two_to(1), part), sketch.constant(part, 0));
  } else {
    const int places = number.width - 1;
    of_mantissa = sketch.table([](double f) { return std::log1p(f); }, sketch.bits(number.mantissa, 0, places, places),
                               {false, 0, fraction});
  }
  const Signal power = sketch.difference(number.place, sketch.constant({true, 7, 0}, x.fraction), {true, 6, 0});
  const Signal of_power = sketch.scaled(power, std::numbers::ln2, fraction + 6, part);
  sketch.output("y_o", sketch.sum(of_mantissa, of_power, y));
  return sketch.done();
}

Compound exponential(const Format& x, const Format& y, const FunctionOptions& options) {
  Sketch sketch(function_name("exponential", {x, y}, options), options.multiplier, options.interval);
  const Signal in = sketch.input("x_i", x);
  const int fraction = std::max(4, y.integer + y.fraction + 3);
  // exp(x) = 2^power 2^rest
  const Format turns{true, std::max(2, x.integer + 1), fraction};
  const Signal exponent = sketch.scaled(in, std::numbers::log2e, fraction + x.integer + 2, turns);
  const Signal power = sketch.convert(exponent, {true, turns.integer, 0}, {Rounding::kDown, Overflow::kWrap});
  const Signal rest = sketch.bits(exponent, 0, fraction, fraction);
  const Format result{false, 1, fraction};
  Signal mantissa{};
  if (options.form == Form::kCordic) {
    // in units of log 2, angles need no product; x and y begin equal, so that cosh + sinh comes out of either
    const Rotation rotation{Cordic::Mode::kHyperbolic, false, fraction, 2, std::numbers::ln2};
    const Signal start = sketch.constant(rotation.xy(), 1 / rotation.cordic().gain());
    mantissa = sketch.convert(rotation.of(sketch, start, start, rest).x, result);
  } else {
    mantissa = sketch.table([](double f) { return std::exp2(f); }, rest, result);
  }
  // 2^(integer of y) is out of range and 2^(-fraction - 2) is 0: shifts in between are enough
  const int span = y.integer + y.fraction + 2;
  const Format places{false, ceil_log2(static_cast<std::uint64_t>(span) + 1), 0};
  const Signal top = sketch.constant({true, 7, 0}, y.integer);
  const Signal shift = sketch.difference(top, power, places);
  const Signal number = mantissa.times_two_to(y.integer);
  const Format magnitude{false, y.integer, y.fraction};
  const Signal size = sketch.op(Scale{number.format, places.width(), magnitude}, magnitude, number, shift);
  sketch.output("y_o", y.sign ? sketch.convert(size, y) : size);
  return sketch.done();
}

}  // namespace mote::hardware

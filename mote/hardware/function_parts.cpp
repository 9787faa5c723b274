#include "mote/hardware/function_parts.hpp"

#include <algorithm>

#include "mote/hardware/shift.hpp"

namespace mote::hardware {

std::string function_name(const std::string& function, const std::vector<Format>& formats,
                          const FunctionOptions& options) {
  std::string name = "mote_" + function;
  for (const Format& format : formats) name += "_" + format.name();
  std::replace(name.begin(), name.end(), '.', '_');
  std::replace(name.begin(), name.end(), '-', 'm');
  if (options.form == Form::kCordic) name += "_cordic";
  if (options.multiplier == Multiplier::kLogic) name += "_logic";
  return name;
}

Floating floating(Sketch& sketch, const Signal& x, const Signal& also) {
  const int width = x.format.width();
  const Normalise normalise{width};
  const Format mantissa{false, 1, width - 1};
  const Signal place = sketch.op(normalise, {false, normalise.e_width(), 0}, x, also);
  return {{{place.wire.node, 1}, mantissa}, place, {{place.wire.node, 2}, mantissa}, width};
}

Floating floating(Sketch& sketch, const Signal& x) { return floating(sketch, x, sketch.constant(x.format, 0)); }

Rotated Rotation::of(Sketch& sketch, const Signal& x, const Signal& y, const Signal& z) const {
  const Signal first =
      sketch.op(cordic(), xy(), sketch.convert(x, xy()), sketch.convert(y, xy()), sketch.convert(z, angle()));
  return {first, {{first.wire.node, 1}, xy()}, {{first.wire.node, 2}, angle()}};
}

Signal reciprocal_of_mantissa(Sketch& sketch, const Signal& mantissa, int fraction, Form form) {
  const Format result{false, 1, fraction};
  if (form == Form::kCordic) {
    const Rotation divide{Cordic::Mode::kLinear, true, fraction, 2};
    const Signal one = sketch.constant(divide.xy(), 1);
    return sketch.convert(divide.of(sketch, mantissa, one, sketch.constant(divide.angle(), 0)).z, result);
  }
  const int places = mantissa.format.fraction;
  return sketch.table([](double f) { return 1 / (1 + f); }, sketch.bits(mantissa, 0, places, places), result);
}

}  // namespace mote::hardware

#include "mote/hardware/sketch.hpp"

namespace mote::hardware {

Signal Sketch::scaled(const Signal& a, double c, int bits, const Format& y, Overflow overflow) {
  const auto [word, fraction] = constant_word(c, bits);
  return op(ConstantProduct{a.format, y, word, fraction, {Rounding::kNearest, overflow}}, y, a);
}

Signal Sketch::bits(const Signal& a, int first, int count, int fraction) {
  const Convert taken = bits_of(a.format, first, count, fraction);
  return op(taken, taken.y, a);
}

Signal Sketch::sign(const Signal& a) {
  if (!a.format.sign) return constant({false, 1, 0}, 0);
  return bits(a, a.format.width() - 1, 1);
}

Signal Sketch::magnitude(const Signal& a, const Signal& sign_of_a) {
  if (!a.format.sign) return a;
  return negate_if(sign_of_a, a, {false, a.format.integer + 1, a.format.fraction});
}

Signal Sketch::table(const std::function<double(double)>& function, const Signal& a, const Format& y, Fold fold) {
  return op(fit_piecewise(function, a.format, y, fold, 0, {1.0, 2, multiplier_}), y, a);
}

}  // namespace mote::hardware

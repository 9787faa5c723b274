#include "mote/hardware/sketch.hpp"

#include <algorithm>

namespace mote::hardware {
namespace {

/// How a result in [least, greatest] steps of 2^-fraction is finished: what cannot overflow needs no saturation, and
/// what loses no bits no rounding.
Finish finish_of(WideWord least, WideWord greatest, int fraction, const Format& y, Rounding rounding) {
  const int drop = fraction - y.fraction;
  const auto at = [&](Word end) {
    return drop >= 0 ? static_cast<WideWord>(end) << drop : static_cast<WideWord>(end) >> -drop;
  };
  const bool fits = least >= at(y.least()) && greatest <= at(y.greatest());
  return {drop > 0 ? rounding : Rounding::kDown, fits ? Overflow::kWrap : Overflow::kSaturate};
}

}  // namespace

Signal Sketch::added(Sum sum, const Signal& a, const Signal& b) {
  const int fraction = std::max(sum.a.fraction, sum.b.fraction);
  const auto at = [&](Word end, const Format& f) { return static_cast<WideWord>(end) << (fraction - f.fraction); };
  const WideWord low = at(sum.subtract ? sum.b.greatest() : sum.b.least(), sum.b);
  const WideWord high = at(sum.subtract ? sum.b.least() : sum.b.greatest(), sum.b);
  const WideWord least = at(sum.a.least(), sum.a) + (sum.subtract ? -low : low);
  const WideWord greatest = at(sum.a.greatest(), sum.a) + (sum.subtract ? -high : high);
  sum.finish = finish_of(least, greatest, fraction, sum.y, sum.finish.rounding);
  return op(sum, sum.y, a, b);
}

Signal Sketch::product(const Signal& a, const Signal& b, const Format& y) {
  const auto at = [](Word x, Word z) { return static_cast<WideWord>(x) * z; };
  const WideWord corners[] = {at(a.format.least(), b.format.least()), at(a.format.least(), b.format.greatest()),
                              at(a.format.greatest(), b.format.least()), at(a.format.greatest(), b.format.greatest())};
  const auto [least, greatest] = std::minmax_element(std::begin(corners), std::end(corners));
  const Finish finish = finish_of(*least, *greatest, a.format.fraction + b.format.fraction, y, Rounding::kNearest);
  return op(Product{a.format, b.format, y, multiplier_, finish}, y, a, b);
}

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

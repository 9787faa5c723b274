#include "mote/hardware/sketch.hpp"

#include <algorithm>

namespace mote::hardware {
namespace {

/// Bits of two factors whose product a word of 62 bits holds.
constexpr int kMostOfProduct = 60;

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
  const bool takes_turns = compound_.interval() > 1 && a.format.width() + b.format.width() < kMostOfProduct;
  if (takes_turns) return product_in_turn(a, b, y, finish);
  return op(Product{a.format, b.format, y, multiplier_, finish}, y, a, b);
}

/// The same by a multiplier that adds: half a step of the result in place of rounding.
Signal Sketch::product_in_turn(const Signal& a, const Signal& b, const Format& y, Finish finish) {
  const auto signed_of = [&](const Signal& x) {
    const Format wide{true, x.format.integer, x.format.fraction};
    return x.format.sign ? x : convert(x, wide, {Rounding::kDown, Overflow::kWrap});
  };
  const Signal left = signed_of(a);
  const Signal right = signed_of(b);
  const int fraction = a.format.fraction + b.format.fraction;
  const int drop = fraction - y.fraction;
  const Word half = finish.rounding == Rounding::kNearest && drop > 0 ? Word{1} << (drop - 1) : 0;
  const Format offset{true, half == 0 ? 1 : drop, 0};
  const MultiplyAdd unit{left.format.width(), right.format.width(), offset.width(),
                         left.format.width() + right.format.width(), multiplier_};
  const Format whole{true, unit.y_width - 1 - fraction, fraction};
  const Signal exact = op(unit, whole, left, right, constant(offset, static_cast<double>(half)));
  if (finish.overflow == Overflow::kWrap) return convert(exact, y, {Rounding::kDown, Overflow::kWrap});
  return op(Finished{whole, y, {Rounding::kDown, Overflow::kSaturate}}, y, exact);
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
  return polynomial(fit_piecewise(function, a.format, y, fold, 0, {1.0, 2, multiplier_}), a);
}

/// Where operators take turns, by Horner's rule on multipliers that add: what mote_piecewise does by its own.
Signal Sketch::polynomial(const Piecewise& unit, const Signal& a) {
  const Format& y = unit.shape().y;
  if (compound_.interval() == 1) return op(unit, y, a);
  const PiecewiseCell cell{unit};
  const std::vector<Format> formats = cell.formats();
  const Signal c0 = op(cell, formats[0], a);
  const auto word = [&](std::size_t k) { return Signal{{c0.wire.node, c0.wire.port + k}, formats[k]}; };
  const Signal delta = word(3);
  const int places = delta.format.width();
  // factor d 2^-places + c, of which `dropped` bits fall off
  const auto line = [&](const Signal& factor, const Signal& c, int dropped) {
    const Signal lifted = convert(c, {true, c.format.integer, places}, {Rounding::kDown, Overflow::kWrap});
    const int width = std::max(factor.format.width() + places, lifted.format.width()) + 1;
    const Format whole{true, width - 1 - places - dropped, places + dropped};
    const Signal sum = op(MultiplyAdd{factor.format.width(), places, lifted.format.width(), width, multiplier_}, whole,
                          factor, delta, lifted);
    return convert(sum, {true, whole.integer, 0}, {Rounding::kDown, Overflow::kWrap});
  };
  const Signal slope = unit.shape().degree == 1 ? word(1) : line(word(2), word(1), 0);
  const Signal kept = line(slope, c0, unit.shape().guard);
  const Format bare{y.sign, y.integer + y.fraction, 0};
  const Signal result = cell.odd()
                            ? negate_if(word(4), kept, bare)
                            : op(Finished{kept.format, bare, {Rounding::kDown, Overflow::kSaturate}}, bare, kept);
  return {result.wire, y};
}

}  // namespace mote::hardware

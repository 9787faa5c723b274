#pragma once
/// A compound written as formulas: wires that know their formats.

#include <string>

#include "mote/hardware/arithmetic.hpp"
#include "mote/hardware/choice.hpp"
#include "mote/hardware/compound.hpp"
#include "mote/hardware/piecewise.hpp"

namespace mote::hardware {

/// A wire and what it holds.
struct Signal {
  Wire wire;
  Format format;

  /// The same bits, worth 2^places as much.
  Signal times_two_to(int places) const {
    return {wire, {format.sign, format.integer + places, format.fraction - places}};
  }
};

/// Results round to nearest and saturate, unless a function says otherwise; sums and products that fit spare either.
class Sketch {
 public:
  Sketch(std::string name, Multiplier multiplier, int interval = 1)
      : compound_(std::move(name), interval), multiplier_(multiplier) {}

  Signal input(const std::string& name, const Format& format) { return {compound_.input(name, format), format}; }
  Signal standing(const std::string& name, const Format& format) { return {compound_.standing(name, format), format}; }
  void output(const std::string& name, const Signal& signal) { compound_.output(name, signal.format, signal.wire); }
  Compound done() { return std::move(compound_); }
  int ready(const Signal& signal) const { return compound_.ready(signal.wire); }

  /// The number of the format that is nearest to a value.
  Signal constant(const Format& format, double value) {
    return {compound_.constant(format, format.nearest(value)), format};
  }
  Signal sum(const Signal& a, const Signal& b, const Format& y, Rounding rounding = Rounding::kNearest) {
    return added({a.format, b.format, y, false, {rounding, {}}}, a, b);
  }
  Signal difference(const Signal& a, const Signal& b, const Format& y) {
    return added({a.format, b.format, y, true}, a, b);
  }
  Signal product(const Signal& a, const Signal& b, const Format& y);
  /// a c, the constant with so many significant bits; `overflow` says whether it wraps, as phases do.
  Signal scaled(const Signal& a, double c, int bits, const Format& y, Overflow overflow = Overflow::kSaturate);
  Signal convert(const Signal& a, const Format& y, Finish finish = {}) {
    return op(Convert{a.format, y, finish}, y, a);
  }
  /// The `count` bits from bit `first` on, with `fraction` of them after the point.
  Signal bits(const Signal& a, int first, int count, int fraction = 0);
  /// The sign of a signed number, 1 where it is negative; 0 for unsigned ones.
  Signal sign(const Signal& a);
  /// |a|, unsigned, exact.
  Signal magnitude(const Signal& a, const Signal& sign_of_a);
  Signal negate_if(const Signal& s, const Signal& a, const Format& y) { return op(NegateIf{a.format, y}, y, s, a); }
  Signal less(const Signal& a, const Signal& b) { return op(Less{a.format, b.format}, {false, 1, 0}, a, b); }
  Signal select(const Signal& s, const Signal& a, const Signal& b, bool registered = true) {
    return op(Select{a.format, registered}, a.format, s, a, b);
  }
  Signal extremum(const Signal& a, const Signal& b, bool greater) {
    return op(Extremum{a.format, greater}, a.format, a, b);
  }
  /// A function of one signal by a table of polynomials.
  Signal table(const std::function<double(double)>& function, const Signal& a, const Format& y,
               Fold fold = Fold::kPlain);
  /// The same of a table that there is.
  Signal polynomial(const Piecewise& unit, const Signal& a);
  /// Any operator: its first output, of which the others have the wires that follow.
  template <Operator O, class... Signals>
  Signal op(const O& one, const Format& y, const Signals&... operands) {
    return {compound_.add(one, {operands.wire...}), y};
  }

 private:
  Signal added(Sum sum, const Signal& a, const Signal& b);
  Signal product_in_turn(const Signal& a, const Signal& b, const Format& y, Finish finish);

  Compound compound_;
  Multiplier multiplier_;
};

}  // namespace mote::hardware

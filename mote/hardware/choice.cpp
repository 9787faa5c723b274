#include "mote/hardware/choice.hpp"

namespace mote::hardware {

Circuit Less::circuit() const {
  std::vector<Parameter> parameters;
  append_format(parameters, "A", a);
  append_format(parameters, "B", b);
  return {"mote_less", parameters, {port("a_i", a), port("b_i", b)}, {{"y_o", 1, false}}, 1};
}

Circuit Select::circuit() const {
  return {"mote_select",
          {parameter("Width", y.width()), parameter("Register", registered)},
          {{"s_i", 1, false}, port("a_i", y), port("b_i", y)},
          {port("y_o", y)},
          registered ? 1 : 0};
}

Circuit Extremum::circuit() const {
  return {"mote_extremum",
          {parameter("Signed", y.sign), parameter("Width", y.width()), parameter("Greater", greater)},
          {port("a_i", y), port("b_i", y)},
          {port("y_o", y)},
          2};
}

Circuit NegateIf::circuit() const {
  return {"mote_negate_if",
          {parameter("ASigned", a.sign), parameter("AWidth", a.width()), parameter("YSigned", y.sign),
           parameter("YWidth", y.width())},
          {{"s_i", 1, false}, port("a_i", a)},
          {port("y_o", y)},
          1};
}

Circuit Convert::circuit() const {
  std::vector<Parameter> parameters;
  append_format(parameters, "A", a);
  append_format(parameters, "Y", y);
  append_finish(parameters, finish);
  return {"mote_convert", parameters, {port("a_i", a)}, {port("y_o", y)}, 0};
}

Circuit Finished::circuit() const {
  return {"mote_finish",
          {parameter("InWidth", a.width()), parameter("InFraction", a.fraction), parameter("OutSigned", y.sign),
           parameter("OutWidth", y.width()), parameter("OutFraction", y.fraction),
           parameter("Nearest", finish.rounding == Rounding::kNearest),
           parameter("Saturate", finish.overflow == Overflow::kSaturate), parameter("InRegister", false)},
          {port("x_i", a)},
          {port("y_o", y)},
          1};
}

Convert bits_of(const Format& a, int first, int count, int fraction) {
  // in units of the first bit kept, which is worth 2^-fraction
  const Format as_if{a.sign, a.width() - (a.sign ? 1 : 0) - first - fraction, first + fraction};
  return {as_if, {false, count - fraction, fraction}, {Rounding::kDown, Overflow::kWrap}};
}

}  // namespace mote::hardware

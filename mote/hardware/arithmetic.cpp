#include "mote/hardware/arithmetic.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mote::hardware {
namespace {

/// Does mote_add need its second stage?
bool refined(const Sum& sum) {
  constexpr int kOneStage = 22;
  const int fraction = std::max(sum.a.fraction, sum.b.fraction);
  const int bits = std::max(sum.a.width() + fraction - sum.a.fraction, sum.b.width() + fraction - sum.b.fraction) + 2;
  const bool rounds = sum.finish.rounding == Rounding::kNearest && fraction > sum.y.fraction;
  return bits > kOneStage && (rounds || sum.finish.overflow == Overflow::kSaturate);
}

std::vector<Parameter> operands(const Format& a, const Format& b, const Format& y) {
  std::vector<Parameter> parameters;
  append_format(parameters, "A", a);
  append_format(parameters, "B", b);
  append_format(parameters, "Y", y);
  return parameters;
}

}  // namespace

Circuit Sum::circuit() const {
  auto parameters = operands(a, b, y);
  parameters.push_back(parameter("Subtract", subtract));
  append_finish(parameters, finish);
  return {"mote_add", parameters, {port("a_i", a), port("b_i", b)}, {port("y_o", y)}, refined(*this) ? 2 : 1};
}

Circuit Product::circuit() const {
  auto parameters = operands(a, b, y);
  append_finish(parameters, finish);
  parameters.push_back(parameter("Logic", multiplier == Multiplier::kLogic));
  const bool rounds = finish.rounding == Rounding::kNearest && a.fraction + b.fraction > y.fraction;
  const bool finished = finish.overflow == Overflow::kSaturate || (rounds && multiplier == Multiplier::kLogic);
  const int latency = product_latency(multiplier, b.sign ? b.width() : b.width() + 1) + (finished ? 1 : 0);
  return {"mote_multiply", parameters, {port("a_i", a), port("b_i", b)}, {port("y_o", y)}, latency};
}

Circuit MultiplyAdd::circuit() const {
  Circuit one{"mote_multiply_add",
              {parameter("AWidth", a_width), parameter("BWidth", b_width), parameter("CWidth", c_width),
               parameter("YWidth", y_width), parameter("Logic", multiplier == Multiplier::kLogic)},
              {{"a_i", a_width, true}, {"b_i", b_width, true}, {"c_i", c_width, true}},
              {{"y_o", y_width, true}},
              product_latency(multiplier, b_width) + (multiplier == Multiplier::kLogic ? 1 : 0)};
  one.sharing = Sharing::kWidened;
  return one;
}

int SignedDigits::count() const { return std::popcount(plus) + std::popcount(minus); }

int SignedDigits::width() const { return std::max(1, static_cast<int>(std::bit_width(plus | minus))); }

SignedDigits signed_digits(Word number) {
  SignedDigits digits;
  for (int place = 0; number != 0; ++place, number >>= 1) {
    if ((number & 1) == 0) continue;
    const bool minus = (number & 3) == 3;
    (minus ? digits.minus : digits.plus) |= std::uint64_t{1} << place;
    number += minus ? 1 : -1;
  }
  return digits;
}

Circuit ConstantProduct::circuit() const {
  const SignedDigits digits = signed_digits(constant);
  const int depth = std::max(1, ceil_log2(static_cast<std::uint64_t>(std::max(1, digits.count()))));
  std::vector<Parameter> parameters;
  append_format(parameters, "A", a);
  parameters.push_back(parameter("CWidth", digits.width()));
  parameters.push_back(parameter("CFraction", constant_fraction));
  parameters.push_back(parameter("Plus", digits.width(), digits.plus));
  parameters.push_back(parameter("Minus", digits.width(), digits.minus));
  parameters.push_back(parameter("Depth", depth));
  append_format(parameters, "Y", y);
  append_finish(parameters, finish);
  return {"mote_multiply_constant", parameters, {port("a_i", a)}, {port("y_o", y)}, 1 + depth};
}

ConstantWord constant_word(double value, int bits) {
  int exponent = 0;
  std::frexp(value, &exponent);
  const int fraction = bits - exponent;
  return {static_cast<Word>(std::nearbyint(std::ldexp(value, fraction))), fraction};
}

}  // namespace mote::hardware

#pragma once
/// Sums and products in fixed point: golden twins of mote_add, mote_multiply and mote_multiply_constant.

#include <cstdint>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// How a product is made: by DSP blocks, or by a tree of adders where a device has none.
enum class Multiplier : bool { kDsp, kLogic };

/// Clocks of a full product with an operand b of so many bits: mote_product.
constexpr int product_latency(Multiplier multiplier, int b_width) {
  if (multiplier == Multiplier::kDsp) return 2;
  return b_width > 2 ? ceil_log2(static_cast<std::uint64_t>(b_width)) : 1;
}

/// y = a + b, or a - b.
///
/// error   half a step of y (one step when rounded down), where y is in range
struct Sum {
  Format a, b, y;
  bool subtract = false;
  Finish finish = {};

  Word operator()(Word left, Word right) const {
    const int fraction = a.fraction > b.fraction ? a.fraction : b.fraction;
    const WideWord first = static_cast<WideWord>(left) << (fraction - a.fraction);
    const WideWord second = static_cast<WideWord>(right) << (fraction - b.fraction);
    return resized(subtract ? first - second : first + second, fraction, y, finish);
  }
  void compute(Columns in, Results out) const { each(in[0], in[1], out[0], *this); }
  Circuit circuit() const;
};

/// y = a b.
///
/// error   half a step of y (one step when rounded down), where y is in range
struct Product {
  Format a, b, y;
  Multiplier multiplier = Multiplier::kDsp;
  Finish finish = {};

  Word operator()(Word left, Word right) const {
    return resized(static_cast<WideWord>(left) * right, a.fraction + b.fraction, y, finish);
  }
  void compute(Columns in, Results out) const { each(in[0], in[1], out[0], *this); }
  Circuit circuit() const;
};

/// y = a b + c, exact, all signed: what products take turns at where a row comes every few clocks. A product's rounding
/// is its c.
///
/// shape   y_width: enough for the result, at most 62
struct MultiplyAdd {
  int a_width, b_width, c_width, y_width;
  Multiplier multiplier = Multiplier::kDsp;

  void compute(Columns in, Results out) const {
    for (std::size_t i = 0; i < out[0].size(); ++i) out[0][i] = in[0][i] * in[1][i] + in[2][i];
  }
  Circuit circuit() const;
};

/// The non-adjacent signed digits of a number: plus - minus, no two digits side by side, so the fewest there are.
struct SignedDigits {
  std::uint64_t plus = 0;
  std::uint64_t minus = 0;
  int count() const;
  int width() const;  ///< bits that hold both, at least 1
};

/// shape   |number| < 2^61
SignedDigits signed_digits(Word number);

/// y = a c, c a word of `constant_fraction` bits after the point, by shifts and additions.
///
/// error   half a step of y (one step when rounded down) beside what c lost when it became a word
struct ConstantProduct {
  Format a, y;
  Word constant = 1;
  int constant_fraction = 0;
  Finish finish = {};

  Word operator()(Word operand) const {
    return resized(static_cast<WideWord>(operand) * constant, a.fraction + constant_fraction, y, finish);
  }
  void compute(Columns in, Results out) const { each(in[0], out[0], *this); }
  Circuit circuit() const;
};

/// A constant as the word of `bits` significant bits that is nearest to it.
struct ConstantWord {
  Word word;
  int fraction;
};

/// shape   value finite and not 0; bits from 2 to 60
ConstantWord constant_word(double value, int bits);

}  // namespace mote::hardware

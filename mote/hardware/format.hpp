#pragma once
/// Numbers in fixed point: what a bus of a circuit holds, and how a number moves from one format to another.

#include <cstdint>
#include <string>

namespace mote::hardware {

/// What a bus holds: the number in units of its format's step.
using Word = std::int64_t;
/// What holds the full product of two words.
__extension__ using WideWord = __int128;

enum class Rounding : bool {
  kDown,    ///< towards minus infinity: bits fall off
  kNearest  ///< to the nearest, ties up
};

enum class Overflow : bool {
  kWrap,     ///< the upper bits fall off: for numbers whose range is known to fit
  kSaturate  ///< the closest number that the format holds
};

/// A fixed-point format: `integer` bits before the point, `fraction` after it, and a sign bit.
///
/// shape   width() from 1 to 62; integer or fraction may be negative: (true, -3, 20) holds |x| < 1/8
struct Format {
  bool sign = true;
  int integer = 0;
  int fraction = 0;

  constexpr int width() const { return integer + fraction + (sign ? 1 : 0); }
  constexpr Word greatest() const { return (Word{1} << (integer + fraction)) - 1; }
  constexpr Word least() const { return sign ? -(Word{1} << (integer + fraction)) : 0; }
  /// The distance of two neighbours:  2^-fraction.
  double step() const;
  double value(Word word) const { return static_cast<double>(word) * step(); }
  /// The word nearest to a number, ties to even; numbers out of range saturate, NaN is 0.
  Word nearest(double number) const;
  /// "s5.12" or "u0.32".
  std::string name() const;

  friend constexpr bool operator==(const Format&, const Format&) = default;
};

/// How a result that is exact becomes one of a format.
struct Finish {
  Rounding rounding = Rounding::kNearest;
  Overflow overflow = Overflow::kSaturate;

  friend constexpr bool operator==(const Finish&, const Finish&) = default;
};

/// A number of `fraction` bits after the point in another format; mote_resize in hardware.
///
/// shape   fraction and to.fraction differ by 62 at most
inline Word resized(WideWord number, int fraction, const Format& to, Finish finish = {}) {
  const int drop = fraction - to.fraction;
  if (drop <= 0) {
    number <<= -drop;
  } else {
    if (finish.rounding == Rounding::kNearest) number += WideWord{1} << (drop - 1);
    number >>= drop;
  }
  if (finish.overflow == Overflow::kSaturate) {
    if (number > to.greatest()) return to.greatest();
    if (number < to.least()) return to.least();
    return static_cast<Word>(number);
  }
  const int unused = 64 - to.width();
  const auto kept = static_cast<std::uint64_t>(number) << unused;
  return to.sign ? static_cast<Word>(kept) >> unused : static_cast<Word>(kept >> unused);
}

/// The least d with 2^d >= n.
///
/// shape   n >= 1
constexpr int ceil_log2(std::uint64_t n) {
  int bits = 0;
  while ((std::uint64_t{1} << bits) < n) ++bits;
  return bits;
}

}  // namespace mote::hardware

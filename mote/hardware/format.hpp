#pragma once
/// Numbers in fixed point: what a bus of a circuit holds, in a format of the graph, and how a number moves from one to
/// another.

#include <cstdint>

#include "mote/graph/format.hpp"

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

using graph::Format;

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

#pragma once
/// Fixed-point numbers: how many bits stand before and after the point.

#include <cstdint>
#include <string>

#include "mote/graph/interval.hpp"

namespace mote::graph {

/// A fixed-point format: `integer` bits before the point, `fraction` after it, and a sign bit. Whole numbers, its
/// words, stand for word 2^-fraction.
///
///   range   [-2^integer, 2^integer - 2^-fraction] if it has a sign, else from 0 on
///
/// shape   width() from 1 to 62; integer or fraction may be negative, bits that are not there: (true, -3, 20) holds |x|
/// < 1/8
struct Format {
  bool sign = true;
  int integer = 0;
  int fraction = 0;

  constexpr int width() const { return integer + fraction + (sign ? 1 : 0); }
  constexpr std::int64_t greatest() const { return (std::int64_t{1} << (integer + fraction)) - 1; }
  constexpr std::int64_t least() const { return sign ? -(std::int64_t{1} << (integer + fraction)) : 0; }
  /// The distance of two neighbours:  2^-fraction.
  double step() const;
  double value(std::int64_t word) const { return static_cast<double>(word) * step(); }
  /// The word nearest to a number, ties to even; numbers out of range saturate, NaN is 0.
  std::int64_t nearest(double number) const;
  /// "s5.12" or "u0.32": sign, bits before and after the point.
  std::string name() const;

  friend constexpr bool operator==(const Format&, const Format&) = default;
};

/// Products and aligned sums before they are rounded.
__extension__ using Wide = __int128;

/// What becomes of bits that a format has no place for. Numbers beyond a format's range always become its nearest
/// number: nothing wraps.
enum class Rounding : std::uint8_t {
  kNearest,   ///< halves upwards: floor(x + 1/2)
  kTruncate,  ///< floor(x)
};

/// The word of the format that stands for a value; NaN becomes 0.
std::int64_t to_fixed(double value, const Format& format, Rounding rounding);

/// raw 2^-fraction in the format, for a number with another fraction.
std::int64_t rescaled(Wide raw, int fraction, const Format& format, Rounding rounding);

/// The smallest format with that fraction which holds an interval. Where that takes more than `most` bits the fraction
/// is shorter; an interval without end has `most` bits and saturates.
Format format_for(const Interval& interval, int fraction, int most = 40);

}  // namespace mote::graph

#pragma once
/// Fixed-point numbers: how many bits stand before and after the point.

#include <cstdint>
#include <string>

#include "mote/graph/interval.hpp"

namespace mote::graph {

/// Whole numbers `raw` that stand for raw 2^-fraction.
///
///   range   [-2^integer, 2^integer - 2^-fraction] if it has a sign, else from 0 on
///
/// shape   integer and fraction may be negative: bits that are not there; 1 to 62 bits in all
struct Format {
  bool sign = true;
  int integer = 0, fraction = 0;

  int bits() const { return integer + fraction + (sign ? 1 : 0); }
  std::int64_t least() const { return sign ? -(std::int64_t{1} << (integer + fraction)) : 0; }
  std::int64_t most() const { return (std::int64_t{1} << (integer + fraction)) - 1; }
  friend bool operator==(const Format&, const Format&) = default;
};

/// Products and aligned sums before they are rounded.
__extension__ using Wide = __int128;

/// What becomes of bits that a format has no place for. Numbers beyond a format's range always become its nearest
/// number: nothing wraps.
enum class Rounding : std::uint8_t {
  kNearest,   ///< halves upwards: floor(x + 1/2)
  kTruncate,  ///< floor(x)
};

/// The number of the format that stands for a value; NaN becomes 0.
std::int64_t to_fixed(double value, const Format& format, Rounding rounding);

/// The value of a number.
double from_fixed(std::int64_t raw, const Format& format);

/// raw 2^-fraction in the format, for a number with another fraction.
std::int64_t rescaled(Wide raw, int fraction, const Format& format, Rounding rounding);

/// The smallest format with that fraction which holds an interval. Where that takes more than `most` bits the fraction
/// is shorter; an interval without end has `most` bits and saturates.
Format format_for(const Interval& interval, int fraction, int most = 40);

/// "s5.12": sign, bits before and after the point; "u" without a sign.
std::string name_of(const Format& format);

}  // namespace mote::graph

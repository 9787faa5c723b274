#include "mote/graph/format.hpp"

#include <algorithm>
#include <cmath>

namespace mote::graph {
namespace {

/// Whether a format without a sign, or with one, has that many bits before the point for the interval.
bool holds(const Interval& interval, bool sign, int integer) {
  const double end = std::ldexp(1.0, integer);
  return interval.high < end && (!sign || interval.low >= -end);
}

}  // namespace

double Format::step() const { return std::ldexp(1.0, -fraction); }

std::int64_t Format::nearest(double number) const {
  if (std::isnan(number)) return 0;
  const double word = std::nearbyint(std::ldexp(number, fraction));
  if (word >= static_cast<double>(greatest())) return greatest();
  return std::max(least(), static_cast<std::int64_t>(std::max(word, -0x1p62)));
}

std::string Format::name() const {
  return (sign ? "s" : "u") + std::to_string(integer) + "." + std::to_string(fraction);
}

std::int64_t to_fixed(double value, const Format& format, Rounding rounding) {
  if (std::isnan(value)) return 0;
  const double scaled = std::ldexp(value, format.fraction);
  const double whole = std::floor(rounding == Rounding::kNearest ? scaled + 0.5 : scaled);
  if (whole <= static_cast<double>(format.least())) return format.least();
  if (whole >= static_cast<double>(format.greatest())) return format.greatest();
  return static_cast<std::int64_t>(whole);
}

std::int64_t rescaled(Wide raw, int fraction, const Format& format, Rounding rounding) {
  const int shift = fraction - format.fraction;
  if (shift > 0) {
    if (rounding == Rounding::kNearest && shift < 120) raw += static_cast<Wide>(1) << (shift - 1);
    raw >>= std::min(shift, 120);
  } else if (shift < 0) {
    // beyond the range anyway where the shift would leave 128 bits
    const Wide bound = static_cast<Wide>(1) << std::max(0, 126 + shift);
    raw = std::clamp<Wide>(raw, -bound, bound) << std::min(-shift, 126);
  }
  return static_cast<std::int64_t>(std::clamp<Wide>(raw, format.least(), format.greatest()));
}

Format format_for(const Interval& interval, int fraction, int most) {
  const bool sign = interval.low < 0;
  int integer = 1 - fraction - (sign ? 1 : 0);  // one bit
  const int bound = most - fraction - (sign ? 1 : 0);
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return {sign, bound, fraction};
  while (!holds(interval, sign, integer)) ++integer;
  return {sign, integer, fraction - std::max(0, integer - bound)};
}

}  // namespace mote::graph

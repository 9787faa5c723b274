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

std::int64_t to_fixed(double value, const Format& format, Rounding rounding) {
  if (std::isnan(value)) return 0;
  const double scaled = std::ldexp(value, format.fraction);
  const double whole = std::floor(rounding == Rounding::kNearest ? scaled + 0.5 : scaled);
  if (whole <= static_cast<double>(format.least())) return format.least();
  if (whole >= static_cast<double>(format.most())) return format.most();
  return static_cast<std::int64_t>(whole);
}

double from_fixed(std::int64_t raw, const Format& format) {
  return std::ldexp(static_cast<double>(raw), -format.fraction);
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
  return static_cast<std::int64_t>(std::clamp<Wide>(raw, format.least(), format.most()));
}

Format format_for(const Interval& interval, int fraction, int most) {
  const bool sign = interval.low < 0;
  int integer = 1 - fraction - (sign ? 1 : 0);  // one bit
  const int bound = most - fraction - (sign ? 1 : 0);
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return {sign, bound, fraction};
  while (!holds(interval, sign, integer)) ++integer;
  return {sign, integer, fraction - std::max(0, integer - bound)};
}

std::string name_of(const Format& format) {
  return (format.sign ? "s" : "u") + std::to_string(format.integer) + "." + std::to_string(format.fraction);
}

}  // namespace mote::graph

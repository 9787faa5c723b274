#include "mote/hardware/datapath/draws.hpp"

#include <cmath>

#include "mote/base/normal.hpp"
#include "mote/hardware/datapath/tables.hpp"
#include "mote/hardware/random.hpp"

namespace mote::hardware {
namespace {

constexpr int bits_of_draw(bool prior) { return prior ? kPriorBits : kMoveBits; }

/// The half plane's number for x >= 0 of so many bits, sign included.
double normal_above(double x, int bits) { return -standard_normal_quantile(x / 2 + std::ldexp(1.0, -bits - 1)); }

/// The bits of a draw, unsigned.
std::uint32_t bits_of_word(std::uint32_t word, bool prior) {
  return prior ? word & ((1U << kPriorBits) - 1) : word >> (32 - kMoveBits);
}

}  // namespace

double normal_draw(std::uint32_t word, bool prior) {
  const int bits = bits_of_draw(prior);
  const std::uint32_t top = 1U << (bits - 1);
  const std::uint32_t m = bits_of_word(word, prior);
  const bool negative = (m & top) != 0;
  const double x = std::ldexp(static_cast<double>((negative ? ~m : m) & (top - 1)), 1 - bits);
  return negative ? -normal_above(x, bits) : normal_above(x, bits);
}

double uniform_draw(std::uint32_t word, bool prior) {
  return std::ldexp(static_cast<double>(bits_of_word(word, prior)), -bits_of_draw(prior));
}

Signal WordDraws::normal(const Signal& word, bool prior, double scale, const Format& y) const {
  const int bits = bits_of_draw(prior);
  const Signal number = prior ? word.times_two_to(31) : word.times_two_to(bits - 1);
  const Signal part = sketch_.convert(number, {true, bits - 1, 0}, {Rounding::kDown, Overflow::kWrap});
  const Signal x = part.times_two_to(1 - bits);
  const auto function = [=](double v) { return scale * normal_above(v, bits); };
  return sketch_.op(smallest_table(function, x.format, y, {Fold::kMirrored}, multiplier_).value(), y, x);
}

Signal WordDraws::uniform(const Signal& word, bool prior, const Format& y) const {
  const int bits = bits_of_draw(prior);
  return sketch_.convert(sketch_.bits(word, prior ? 0 : 32 - bits, bits, bits), y);
}

}  // namespace mote::hardware

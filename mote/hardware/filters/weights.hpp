#pragma once
/// Weights and what chains compare by, golden twins of rtl/filters/mote_weight.sv and mote_log_uniform.sv.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <span>

namespace mote::hardware {

/// Fraction bits of log weights, octaves.
constexpr unsigned kLogFraction = 10;
/// Octaves of a quantum of scale.
constexpr unsigned kQuantum = 8;
/// Quanta below the scale from which on a weight counts as nothing.
constexpr unsigned kNothing = 3;

/// Bits of a weight's mantissa behind its leading one.
constexpr unsigned kMantissaBits = 12;

/// round(2^12 (2^(k / 1024) - 1)): the mantissas of weights, without their leading ones.
const std::array<std::uint16_t, 1024>& exp2_table();
/// round(1024 (log2(1 + m) - m)) at m = (k + 1/2) / 128.
const std::array<std::uint8_t, 128>& log2_table();
/// Writes the tables as exp2.hex and log2.hex, which the circuits read when they are built or simulated.
///
/// error   Refusal (kCannotWrite)
void write_tables(const std::filesystem::path& folder);

/// Minus the binary logarithm of a uniform word u / 2^32, in units of 2^-10.
///
/// error   below 2^-8 octave; word 0 counts as 2^-33 to 2^-32
std::int64_t log_drop(std::uint32_t word);

/// A weight at the scale of the largest so far.
struct ScaledWeight {
  std::uint64_t weight;  ///< 2^(lw - 8 scale) 2^weight_bits by 1 + kMantissaBits bits, cut
  unsigned rise;         ///< quanta that sums so far go down by before it is added, at most kNothing: they begin anew
  std::int64_t scale;    ///< quanta of 8 octaves
};

/// Weights from a step's log weights by one pass over rows of `lanes`, at a scale that rises with the largest so far:
///
///   scale <- max(scale, floor(lw / 8) + 1 of every lane)
///
/// A weight kNothing quanta below the scale is 0.
///
/// shape   weights, log_weights: (n), n a multiple of lanes; the rise of a row is its first weight's
void scale_weights(std::span<const std::int64_t> log_weights, std::size_t lanes, unsigned weight_bits,
                   std::span<ScaledWeight> weights);

/// An unsigned or signed number as many quanta lower, cut; 0 from kNothing quanta on.
template <class Number>
constexpr Number lowered(Number number, unsigned quanta) {
  return quanta >= kNothing ? 0 : number >> (kQuantum * quanta);
}

/// Quanta from a scale up to a later one, at most kNothing.
constexpr unsigned quanta_between(std::int64_t before, std::int64_t after) {
  return static_cast<unsigned>(std::min<std::int64_t>(after - before, kNothing));
}

/// Stages by which the lanes of a row, a power of two of them, come to one: mote_row.
constexpr std::uint64_t row_cycles(std::size_t lanes) { return static_cast<std::uint64_t>(std::countr_zero(lanes)); }

/// Cycles from a row of log weights to its weights.
constexpr std::uint64_t weight_cycles(std::size_t lanes) { return 3 + row_cycles(lanes); }

}  // namespace mote::hardware

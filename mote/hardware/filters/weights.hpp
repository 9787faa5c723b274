#pragma once
/// Weights and what chains compare by, golden twins of rtl/filters/mote_weight.sv and mote_log_uniform.sv.

#include <array>
#include <cstdint>
#include <filesystem>

namespace mote::hardware {

/// Fraction bits of log weights, octaves.
constexpr unsigned kLogFraction = 10;
/// Octaves of a quantum of scale.
constexpr unsigned kQuantum = 8;

/// round(2^15 2^(k / 1024)): the mantissas of weights.
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
  std::uint64_t weight;  ///< 2^(lw - 8 scale) 2^weight_bits, cut
  unsigned rise;         ///< quanta that the scale rose by, at most 7
  std::int64_t scale;    ///< quanta of 8 octaves
};

/// One pass over log weights that gives weights: sums so far go down by `rise` quanta before a weight is added.
///
///   scale <- max(scale, floor(lw / 8) + 1)
class RunningScale {
 public:
  explicit RunningScale(unsigned weight_bits) : weight_bits_(weight_bits) {}

  ScaledWeight first(std::int64_t log_weight) {
    scale_ = needed(log_weight);
    return {weight_of(log_weight), 0, scale_};
  }
  ScaledWeight next(std::int64_t log_weight) {
    const std::int64_t before = scale_;
    if (const std::int64_t need = needed(log_weight); need > scale_) scale_ = need;
    return {weight_of(log_weight), limited(scale_ - before), scale_};
  }

  /// Shifts by a quantum of scale; seven quanta and more count as seven.
  static unsigned limited(std::int64_t quanta) { return quanta > 7 ? 7 : static_cast<unsigned>(quanta); }
  static std::int64_t needed(std::int64_t log_weight) { return (log_weight >> (kLogFraction + 3)) + 1; }

 private:
  std::uint64_t weight_of(std::int64_t log_weight) const {
    const std::uint64_t power = exp2_table()[static_cast<std::size_t>(log_weight & 1023)];
    const auto fine = static_cast<unsigned>(7 - ((log_weight >> kLogFraction) & 7));
    return ((power << (weight_bits_ - 16)) >> (kQuantum * limited(scale_ - needed(log_weight)))) >> fine;
  }

  unsigned weight_bits_;
  std::int64_t scale_ = 0;
};

}  // namespace mote::hardware

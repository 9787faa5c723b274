#pragma once
/// Sums over a step's particles and the means by division, golden twin of rtl/filters/mote_estimate.sv.

#include <cstdint>
#include <span>
#include <vector>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/weights.hpp"

namespace mote::hardware {

/// What a circuit says of a step.
struct Estimate {
  std::vector<std::int64_t> mean;  ///< (dims), extra_bits fraction bits more than the states
  std::uint64_t sum = 0;           ///< of the weights, at `scale`
  std::int64_t scale = 0;          ///< quanta of 8 octaves
  std::uint64_t accepted = 0;      ///< moves of the chain; 0 where there is none

  friend bool operator==(const Estimate&, const Estimate&) = default;
};

/// Binary logarithm of the mean weight, octaves: the step's evidence p(y_t | y_{1:t-1}) but for a constant of the
/// model.
double log2_evidence(const Estimate& estimate, const Formats& formats, std::uint64_t proposals);

/// Sum of a step's weights, at the scale of the last.
std::uint64_t sum_of(std::span<const ScaledWeight> weights);

/// Weighted means of a step's states: floor(sum v x / divisor), each sum going down by the scale's rise before a row is
/// added.
///
/// Products are rounded to value_bits - 1 less, halves up: to a unit of weight, as which weights are cut, times the
/// largest state.
///
/// shape   states: dims columns of n, value_bits each; weights: (n); means: (dims), extra_bits fraction bits more than
///         the states
std::vector<std::int64_t> weighted_means(std::span<const std::vector<std::int64_t>> states,
                                         std::span<const ScaledWeight> weights, std::uint64_t divisor,
                                         const Formats& formats);

/// Cycles from the last row of a step to the sums of its values.
constexpr std::uint64_t sum_cycles(const Formats& f, std::size_t lanes) {
  return 3 + f.product_latency + row_cycles(lanes);
}

/// Cycles from taking the sums of a step to its estimate on the stream.
constexpr std::uint64_t division_cycles(const Formats& f) {
  return 1 + f.dims * std::uint64_t{f.value_bits + f.extra_bits + 1};
}

}  // namespace mote::hardware

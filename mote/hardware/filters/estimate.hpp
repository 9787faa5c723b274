#pragma once
/// Sums over a step's particles and the means by division, golden twin of rtl/filters/mote_estimate.sv.

#include <cstdint>
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

/// Sums of weights, at a scale that rises with them.
class WeightSum {
 public:
  void first(const ScaledWeight& w) { set(w.weight, w.scale); }
  void next(const ScaledWeight& w) { set((sum_ >> (kQuantum * w.rise)) + w.weight, w.scale); }
  std::uint64_t sum() const { return sum_; }
  std::int64_t scale() const { return scale_; }

 private:
  void set(std::uint64_t sum, std::int64_t scale) {
    sum_ = sum;
    scale_ = scale;
  }
  std::uint64_t sum_ = 0;
  std::int64_t scale_ = 0;
};

/// Sums of weighted values: sum v x, each sum going down by the scale's rise before a term is added.
class ValueSums {
 public:
  explicit ValueSums(std::size_t dims) : totals_(dims) {}
  void first(const Particles& states, std::size_t at, std::uint64_t weight) {
    for (std::size_t d = 0; d < totals_.size(); ++d) totals_[d] = term(states[d][at], weight);
  }
  void next(const Particles& states, std::size_t at, std::uint64_t weight, unsigned rise) {
    for (std::size_t d = 0; d < totals_.size(); ++d)
      totals_[d] = (totals_[d] >> (kQuantum * rise)) + term(states[d][at], weight);
  }
  /// Quotients total 2^extra / divisor, cut towards zero.
  std::vector<std::int64_t> divided(std::uint64_t divisor, unsigned extra) const;

 private:
  static std::int64_t term(std::int64_t value, std::uint64_t weight) {
    return value * static_cast<std::int64_t>(weight);
  }
  std::vector<std::int64_t> totals_;
};

/// Cycles from taking the sums of a step to its estimate on the stream.
constexpr std::uint64_t division_cycles(const Formats& f) {
  return 1 + f.dims * std::uint64_t{f.value_bits + f.extra_bits + 1};
}

}  // namespace mote::hardware

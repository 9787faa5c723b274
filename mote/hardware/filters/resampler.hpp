#pragma once
/// The schemes by which a circuit of one lane, or each group of one, resamples: rtl/filters/mote_resampler.sv.

#include <memory>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/parent_walk.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {

/// The numbers are those of mote_resampler.
enum class Resampler {
  kSystematic,          ///< one uniform number a step; two weights a cycle, no division
  kResidualSystematic,  ///< the same with a division; a weight a cycle
  kRoulette,            ///< a uniform number for each child, sought among the cumulative sums
};

/// Where a scheme's uniform words come from: one a step is drawn as the step ends, those of the children as they are.
class ResamplerWords {
 public:
  ResamplerWords(Resampler scheme, Words words) : scheme_(scheme), words_(words) {}

  /// The step's sums stand.
  void end_step() {
    if (scheme_ != Resampler::kRoulette) step_ = words_.next() >> 8;
  }
  /// The number of the step that ended, 24 bits.
  std::uint32_t step_number() const { return step_; }
  /// The walk over what the step left. `count_bits`: At of the circuit, n <= 2^At.
  ///
  /// cost    O(n) cycles of about 10 ns
  std::unique_ptr<ParentWalk> walk(const Weighed& weighed, unsigned weight_bits, unsigned count_bits);

 private:
  Resampler scheme_;
  Words words_;
  std::uint32_t step_ = 0;
};

}  // namespace mote::hardware

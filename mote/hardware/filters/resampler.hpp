#pragma once
/// The schemes by which a circuit resamples: rtl/filters/mote_resample.sv.

#include <memory>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/parent_walk.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {

/// The numbers are those of mote_resample.
enum class Resampler {
  kSystematic,          ///< one uniform number a step; rows of weights, by their cumulative sums
  kResidualSystematic,  ///< the same children; a weight after the other, by what is left of the one before. One lane
  kRoulette,            ///< a uniform number for each child, sought among the cumulative sums. One lane
};

/// Where a scheme's uniform words come from: one a step is drawn as the step ends, those of the children as they are.
class ResamplerWords {
 public:
  ResamplerWords(Resampler scheme, Words words) : scheme_(scheme), words_(words) {}

  /// The step's sums stand.
  void end_step() {
    if (scheme_ != Resampler::kRoulette) step_ = words_.next() >> 8;
  }
  /// The walk over what the step left, which `lanes` go along.
  ///
  /// cost    O(n) cycles of about 10 ns
  std::unique_ptr<ParentWalk> walk(const Weighed& weighed, const Formats& formats, unsigned lanes);

 private:
  Resampler scheme_;
  Words words_;
  std::uint32_t step_ = 0;  ///< the number of the step that ended, 24 bits
};

}  // namespace mote::hardware

#pragma once
/// Word lengths from sensitivities: how finely each number must be known so that a filter does not notice.

#include <vector>

#include "mote/hardware/datapath/plan.hpp"
#include "mote/hardware/format.hpp"

namespace mote::hardware {

/// Formats of a plan's vertices.
struct Precision {
  std::vector<Format> formats;  ///< (graph.size(),)
  std::vector<Format> states;   ///< signed, all of one width
};

/// Formats by linear error analysis on samples: a vertex v whose word has the step D_v keeps
///
///   D_v rms(dx_d / dv) <= e_d for every state d it leads to,   e_d = min(sd of the move's noise in x_d / 16, RMSE /
///   32) D_v rms(dl / dv)   <= 1/16 octave,   l = log2 p(y | x)
///
/// Rounding adds D^2 / 12, so that one word adds less than 0.1 % to a noise's variance. Slopes of l count less where
/// the weight is small: by 1 / (1 + d / 8) at d octaves below the largest l of the samples. A state's own step may
/// change l by a quarter of an octave. No sample may be eight times worse than that, and of pairs of state and parent a
/// quarter: the log of a mixture's density is steep in few places, which must not be averaged away. What floor() and
/// comparisons read is known to 2^-8 and to a thousandth of its range.
///
/// Integer bits hold what was sampled, widened by `margin`, or what interval analysis allows where that costs at most
/// two bits more; words saturate. Where states take more than 26 bits for that, samples of particles that have run away
/// are left out.
///
/// shape   more_bits: after the point, of every word
/// cost    O(samples vertices states)
Precision precision_of(const Plan& plan, const graph::Recorded& recorded, const Samples& samples, double margin,
                       int more_bits);

/// The format of the log weight: octaves.
inline constexpr Format kLogWeight{true, 13, 10};

}  // namespace mote::hardware

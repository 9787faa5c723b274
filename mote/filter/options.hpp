#pragma once
/// What a filter can be told: plain data, defaults as in the papers.

#include <cstddef>
#include <optional>

#include "mote/filter/resample/schemes.hpp"

namespace mote {

/// What to do when every particle has weight zero.
enum class OnCollapse {
  kStop,   ///< report it; the run ends
  kKeep,   ///< go on with the proposed particles, equally weighted
  kReset,  ///< draw the particles anew from the prior and weigh them by the step's observation
};

/// When and how particles are selected.
struct SelectionOptions {
  const Scheme* scheme = &systematic_scheme();
  double ess_threshold = 1;  ///< select when ESS <= threshold N; 1 = every step, 0 = never
  double exponent = 1;       ///< selection probabilities a ~ w^exponent; survivors carry w / a (IMH-OPT II-B)
};

enum class Parents { kIid, kPermuted, kSweep };
enum class ChainStart { kFirst, kWeighted };
enum class ParentWeights {
  kUniform,    ///< g(k) = 1/N
  kLookahead,  ///< g(k) = half uniform, half in proportion to the likelihood of the particle moved without noise
};

/// The Metropolis chains of the IMH filters.
struct ChainOptions {
  std::size_t draws = 0;                   ///< Q, proposals that may be kept; 0 = N
  std::optional<std::size_t> burn_in = 0;  ///< N_b per chain; empty = chosen at every step from mean and largest weight
  std::size_t chains = 1;                  ///< P
  Parents parents = Parents::kIid;
  ChainStart start = ChainStart::kFirst;
  ParentWeights parent_weights = ParentWeights::kUniform;  ///< auxiliary filter only
};

enum class Exchange { kNone, kAppend, kReplace, kSwap };

/// The groups of a distributed filter, on a ring.
struct GroupOptions {
  std::size_t groups = 1;  ///< K
  bool global = false;     ///< resample over all particles instead of inside each group
  Exchange exchange = Exchange::kNone;
  std::size_t exchange_count = 1;  ///< M, the heaviest particles sent to the next group
  bool carry_group_weights =
      true;  ///< false: every group restarts with weight N_k / N after resampling, as PPF's Alg. 5 does
};

}  // namespace mote

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

/// How the chain's proposals choose their parents.
enum class Parents {
  kIid,       ///< uniform, independent: the papers' first choice
  kPermuted,  ///< each once, in a random order: less variance
  kSweep,  ///< each once, in chain order, which the papers allow. Not consistent: neighbours descend from neighbours,
           ///< so every stretch of the chain is a filter of its own whose evidence counts for nothing, and a bias stays
           ///< however large N is
};

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

/// How groups hand particles on; docs/filters.md (F23).
enum class Exchange { kNone, kAppend, kReplace, kSwap };
/// Which groups are neighbours; docs/filters.md (F24a).
enum class Topology { kRing, kBidirectional, kTorus, kHypercube };

/// Over which particles a distributed filter selects.
enum class GroupResampling {
  kLocal,            ///< inside each group
  kGlobal,           ///< over all particles: SISR
  kProportional,     ///< RPA (Bolic, Djuric & Hong 2005): each group's number of children first, then inside it
  kNonProportional,  ///< RNA (the same): inside each group, then a few particles change places with the neighbours'
  kChain,            ///< inside each group, by a Metropolis chain: IMH whose parents are the group's own
};

/// The groups of a distributed filter.
struct GroupOptions {
  std::size_t groups = 1;  ///< K
  GroupResampling resampling = GroupResampling::kLocal;
  Exchange exchange = Exchange::kNone;  ///< before local selection
  std::size_t exchange_count = 1;       ///< M, the particles sent to each neighbour
  Topology topology = Topology::kRing;
  std::size_t exchange_every = 1;  ///< exchange at the steps t that are multiples of it
  double exchange_when = 1;        ///< and only when the effective number of groups is <= this share of K
  bool carry_group_weights =
      true;  ///< false: every group restarts with weight N_k / N after resampling, as PPF's Alg. 5 does

  /// Whether selection is over all particles, not inside groups.
  bool joint() const { return resampling == GroupResampling::kGlobal || resampling == GroupResampling::kProportional; }
  /// Whether groups hand particles on to their neighbours.
  bool exchanges() const {
    return groups > 1 && (resampling == GroupResampling::kNonProportional || exchanges_before());
  }
  /// Whether they do before they select.
  bool exchanges_before() const {
    return exchange != Exchange::kNone &&
           (resampling == GroupResampling::kLocal || resampling == GroupResampling::kChain);
  }
};

}  // namespace mote

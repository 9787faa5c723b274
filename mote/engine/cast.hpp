#pragma once
/// Cast: who of a team's ranks does what in a step, where they share its stages.

#include <algorithm>
#include <cstddef>

#include "mote/engine/plan.hpp"

namespace mote {

/// Who does what: ranks 0 .. P-1 run the chains, rank 0 all that a step does once besides; then come the proposers,
/// then the weighers.
struct Cast {
  std::size_t proposers = 1, weighers = 1, chains = 1;

  std::size_t ranks() const { return chains + proposers + weighers; }
  std::size_t proposer(std::size_t k) const { return chains + k; }
  std::size_t weigher(std::size_t k) const { return chains + proposers + k; }
};

/// Whether ranks are to have the stages of a step, and not shares of the particles.
inline bool has_cast(const Plan& plan) { return plan.engine == Engine::kMpi && plan.proposers + plan.weighers > 0; }

/// The cast of a plan: a rank for each chain, one where SISR resamples.
inline Cast cast_of(const Plan& plan) {
  return {std::max<std::size_t>(plan.proposers, 1), std::max<std::size_t>(plan.weighers, 1),
          plan.filter == FilterKind::kSisr ? 1 : plan.chain.chains};
}

}  // namespace mote

#pragma once
/// Messages: ranks of a team that tell each other one thing after the other, and who of them does what in a step.

#include "mote/engine/plan.hpp"
#include "mote/engine/team.hpp"

namespace mote {

/// A team whose ranks also send single messages. Those between two ranks arrive in the order in which they were sent.
class MessagingTeam : public Team {
 public:
  /// Sends a copy of the bytes; may return before they arrive.
  virtual void send(std::size_t to, std::span<const std::byte> bytes) = 0;
  /// Makes room for the next message of a rank, of this length; await() says when it is there.
  virtual void expect(std::size_t from, std::span<std::byte> bytes) = 0;
  /// Waits for the oldest message that was made room for.
  virtual void await() = 0;
  /// Hands rank 0's bytes to all; they all call it.
  virtual void share(std::span<std::byte> bytes) = 0;
};

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

#pragma once
/// The exact schedule of a step: proposers, weighers and a chain at work, event by event, with their queues and
/// messages.

#include <cstddef>

#include "mote/engine/latency.hpp"

namespace mote::design {

/// What a particle (or a block of them) takes between two stages:  alpha + beta bytes.
///
/// A message occupies its sender's and its receiver's link for beta bytes; the stages go on meanwhile.
struct Message {
  double latency_s = 0;         ///< alpha
  double seconds_per_byte = 0;  ///< beta
  double bytes = 0;

  double link_seconds() const { return seconds_per_byte * bytes; }
};

/// A step: n particles, or blocks of them, through R_p proposers, R_w weighers and one chain.
struct Line {
  std::size_t n = 1;
  StageTimes times{};
  std::size_t proposers = 1, weighers = 1;
  std::size_t queue = 0;  ///< places before the weighers and before the chain, each; 0: no bound
  Message message = {};   ///< to a weigher, and to the chain
};

/// What came of it, in the unit of the times.
struct Schedule {
  double makespan = 0;                ///< until the chain has decided on the last
  double proposing = 0;               ///< in which proposers worked, of all of them together
  double weighing = 0;                ///< likewise
  double blocked = 0;                 ///< in which proposers and weighers held what the next queue had no place for
  std::size_t largest_queue[2] = {};  ///< that waited for a weigher, for the chain
};

/// Plays a step by discrete events: a proposer takes the next particle when it is free; what is finished goes to the
/// queue of the next stage, or blocks its worker while that is full; queues are first come, first served.
///
/// shape   n, proposers, weighers >= 1; times >= 0
/// cost    O(n log(R_p + R_w)) time, O(n) memory
Schedule schedule(const Line& line);

/// The makespan in closed form, where queues have no bound and messages take no time:
///
///   max over q, k of  (q + 1) T_p + (k + 1) T_w + (n - q R_p - k R_w) T_d,   q, k >= 0,   q R_p + k R_w <= n - 1
///
/// (q + 1) T_p is when particle q R_p is proposed, the first of its round; then k + 1 weights one after the other on
/// its weigher, then all that is left on the chain: every way in which something has to wait for something else.
///
/// shape   the line has no queue and no message
/// cost    O(min(n / R_p, R_w)) time
double makespan(const Line& line);

}  // namespace mote::design

#pragma once
/// The best whole numbers of blocks, by the exact schedule, with a proof that nothing better exists.

#include "mote/design/programs.hpp"
#include "mote/design/schedule.hpp"

namespace mote::design {

/// Whole numbers of blocks, R_p and R_w for each chain.
struct WholePlant {
  std::size_t proposers = 1, weighers = 1, chains = 1;
  double exact_time = 0;  ///< the makespan of a chain's line
  double blocks = 0, energy = 0;
};

struct WholeAnswer {
  bool feasible = false;  ///< the limits hold
  WholePlant plant = {};  ///< the best; where nothing is feasible the nearest, which exceeds them by the least factor
  bool proven = false;    ///< every other choice is bounded away from being better
  std::size_t schedules = 0;                                                   ///< that the search played
  bool breaks_deadline = false, breaks_blocks = false, breaks_energy = false;  ///< limits that the nearest exceeds
};

/// A demand's line: n = N_b + ceil(Q/P) proposals through whole numbers of blocks.
Line line_of(const Demand& demand, std::size_t proposers, std::size_t weighers, std::size_t chains,
             std::size_t queue = 0, const Message& message = {});

/// Branch and bound over 1 <= R_p, R_w <= n and 1 <= P <= the most: a box of choices is cut off when its least time (at
/// its most blocks), its least blocks (at its fewest) and its least energy together cannot beat the best known. The
/// makespan never grows with more workers, so these are bounds.
///
/// `queue` and `message` as in Line; with either every schedule is played event by event.
///
/// cost    mostly below a thousand schedules; 100 000 at most, after which the answer is not proven
WholeAnswer optimise_whole(const Demand& demand, std::size_t queue = 0, const Message& message = {});

}  // namespace mote::design

#pragma once
/// The golden model of rtl/filters/mote_imh.sv: the same integers, and the same cycles.

#include <cstdint>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/pace.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {

/// Registers of an IMH circuit, read when a run starts.
struct ImhRegisters {
  std::uint32_t particles = 1000;  ///< N kept
  std::uint32_t draws = 1000;      ///< Q >= N
  std::uint32_t burn_in = 0;       ///< N_b
  bool chain_mean = false;         ///< the mean over the kept states instead of all weighted proposals

  /// Of each of `lanes` chains.
  std::uint32_t proposals(unsigned lanes = 1) const { return draws / lanes + burn_in; }
};

/// Where the parents of a lane come from; the numbers are those of mote_parents.
enum class Parents {
  kPrivate,  ///< its own chain's states
  kBanked,   ///< all chains', every lane from another one
  kShared,   ///< all chains', each lane by itself
};

/// Copies of the chain that run in lockstep, a power of two of them, at most 256.
struct ImhLanes {
  unsigned count = 1;
  Parents parents = Parents::kBanked;
};

/// Cycles of a step, K_p + K_w of them to fill the pipelines:  (N_b + Q/lanes - 1) + K_p + K_w + 1.
///
/// source  IMH-HW section 5.3 with T_p = T_w = T_D = 1
struct ImhLatency {
  std::uint64_t propose, weigh;  ///< K_p and K_w
  explicit ImhLatency(const Formats& f) : propose(4 + f.propose_latency), weigh(f.weigh_latency + 1) {}
  std::uint64_t step(const ImhRegisters& r, unsigned lanes = 1) const {
    return r.proposals(lanes) - 1 + propose + weigh + 1;
  }
};

/// Independent Metropolis-Hastings over proposals from the mixture of the parents, in integers.
///
///   j = 0 .. Q / lanes + N_b - 1 in every lane:  slot = floor(u N / (2^24 lanes)),  x' = propose(x_slot),
///   lw' = weigh(x');  accept  iff  j = 0  or  lw <= lw' + drop;   the last N / lanes states of each chain are the next
///   parents
///
/// Words go on from run to run, as in the circuit, which only a reset takes back.
///
/// shape   N and Q are multiples of the lanes; set() holds slot after slot, the lanes of a slot beside each other
/// cost    about 30 ns a proposal and state, besides the arithmetic's own
/// source  IMH-HW figs. 2 and 3, (16) - (17)
class Imh {
 public:
  Imh(Arithmetic arithmetic, std::uint64_t seed, unsigned stream = 0, ImhLanes lanes = {});

  void start(const ImhRegisters& registers);
  Estimate step(Observed observed);

  /// The set that a step leaves, a column a state.
  const Particles& set() const { return set_; }
  /// Cycles from start_i to the last estimate, with streams that never wait.
  std::uint64_t cycles() const { return pace_.left(); }
  /// The cycle in which the last step began.
  std::uint64_t begun() const { return pace_.begun(); }

 private:
  void choose_parents();
  void propose(Observed observed);
  std::uint64_t decide(unsigned lane);
  Estimate infer();
  void keep_time();

  Arithmetic arithmetic_;
  ImhLanes lanes_;
  std::vector<Words> parent_words_, accept_words_, draw_words_;  // a lane each; draws: lane after lane
  ImhRegisters registers_;
  unsigned t_ = 0;
  Particles set_, parents_, proposals_;
  WordColumns words_;
  std::vector<std::int64_t> log_weights_;
  std::vector<ScaledWeight> weights_;
  std::vector<std::uint32_t> kept_;
  Pace pace_;
};

}  // namespace mote::hardware

#pragma once
/// The golden model of rtl/filters/mote_imh.sv: the same integers, and the same cycles.

#include <cstdint>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/pace.hpp"
#include "mote/hardware/filters/words.hpp"

namespace mote::hardware {

/// Registers of an IMH circuit, read when a run starts.
struct ImhRegisters {
  std::uint32_t particles = 1000;  ///< N kept
  std::uint32_t draws = 1000;      ///< Q >= N
  std::uint32_t burn_in = 0;       ///< N_b
  bool chain_mean = false;         ///< the mean over the kept states instead of all weighted proposals

  std::uint32_t proposals() const { return draws + burn_in; }
};

/// Cycles of a step, K_p + K_w of them to fill the pipelines:  (N_b + Q - 1) + K_p + K_w + 1.
///
/// source  IMH-HW section 5.3 with T_p = T_w = T_D = 1
struct ImhLatency {
  std::uint64_t propose, weigh;  ///< K_p and K_w
  explicit ImhLatency(const Formats& f) : propose(4 + f.propose_latency), weigh(f.weigh_latency + 1) {}
  std::uint64_t step(const ImhRegisters& r) const { return r.proposals() - 1 + propose + weigh + 1; }
};

/// Independent Metropolis-Hastings over proposals from the mixture of the parents, in integers.
///
///   j = 0 .. Q + N_b - 1:  i = floor(u N / 2^24),  x' = propose(x_i),  lw' = weigh(x')
///   accept  iff  j = 0  or  lw <= lw' + drop;   the last N chain states are the next parents
///
/// Words go on from run to run, as in the circuit, which only a reset takes back.
///
/// cost    about 30 ns a proposal and state, besides the arithmetic's own
/// source  IMH-HW fig. 2, (16) - (17)
class Imh {
 public:
  Imh(Arithmetic arithmetic, std::uint64_t seed, unsigned stream = 0);

  void start(const ImhRegisters& registers);
  Estimate step(Observed observed);

  /// The set that a step leaves, a column a state.
  const Particles& set() const { return set_; }
  /// Cycles from start_i to the last estimate, with streams that never wait.
  std::uint64_t cycles() const { return pace_.left(); }
  /// The cycle in which the last step began.
  std::uint64_t begun() const { return pace_.begun(); }

 private:
  void draw(Observed observed);
  std::uint64_t decide();
  Estimate infer() const;
  void keep_time();

  Arithmetic arithmetic_;
  Words parent_words_, accept_words_;
  std::vector<Words> draw_words_;
  ImhRegisters registers_;
  unsigned t_ = 0;
  Particles set_, parents_, proposals_;
  WordColumns words_;
  std::vector<std::int64_t> log_weights_;
  std::vector<std::uint32_t> kept_;
  Pace pace_;
};

}  // namespace mote::hardware

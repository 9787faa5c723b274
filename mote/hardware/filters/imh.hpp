#pragma once
/// The golden model of rtl/filters/mote_imh.sv: the same integers, and the same cycles.

#include <algorithm>
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
};

/// Where the parents of a lane come from; the numbers are those of mote_parents.
enum class Parents {
  kPrivate,  ///< its own chain's states
  kBanked,   ///< all chains', every lane from another one
  kShared,   ///< all chains', each lane by itself
};

/// Pipelines abreast, a power of two of them, at most 256: each before a copy of the chain, or all before one.
struct ImhLanes {
  unsigned count = 1;
  Parents parents = Parents::kBanked;
  bool folded = false;      ///< one chain, which visits a row of proposals lane by lane
  bool overlapped = false;  ///< a step begins while the one before is still decided on

  /// Rows of a step, a proposal a lane: Q/lanes + N_b; of one chain Q/lanes + N_b/lanes, the latter rounded up.
  std::uint32_t rows(const ImhRegisters& r) const {
    return r.draws / count + (folded ? (r.burn_in + count - 1) / count : r.burn_in);
  }
  /// That each need a first proposal.
  std::uint32_t chains() const { return folded ? 1 : count; }
  /// Cycles of the choice whose slot each memory of states reads, where several lanes take turns.
  std::uint64_t turn_latency() const { return count > 1 && parents != Parents::kShared ? 1 : 0; }
  /// Cycles from the log weights of a row to what is decided on it.
  std::uint64_t chain_latency() const { return folded && count > 1 ? count + 2 : 1; }
};

/// Cycles of a step of r rows, one every T, K_p + K_w of them to fill the pipelines:  (r - 1) T + K_p + K_w + 1.
///
/// Overlapped, the last of them are those of the next step: its row j has its parents among the first min(n, n - H + j)
/// of n slots, which have emerged by then.
///
///   step = r + W - H,   W = K_p + K_w - 1,   H = min(W, floor(n / 2)),   n = N / lanes
///
/// Overlapped steps have T = 1.
///
/// source  IMH-HW section 5.3 with T_p = T_w = T, T_D = 1; lanes before one chain: T_D = 1/lanes
struct ImhLatency {
  std::uint64_t propose, weigh;  ///< K_p and K_w
  std::uint64_t interval;        ///< T
  explicit ImhLatency(const Formats& f, const ImhLanes& lanes = {})
      : propose(3 + f.product_latency + lanes.turn_latency() + f.propose_latency),
        weigh(f.weigh_latency + lanes.chain_latency()),
        interval(f.interval) {}
  /// From the beginning of a step to its last decision.
  std::uint64_t decided(const ImhRegisters& r, const ImhLanes& lanes = {}) const {
    return (lanes.rows(r) - 1) * interval + propose + weigh + 1;
  }
  /// H: rows of a step that choose among fewer slots than all.
  std::uint64_t restricted(std::uint32_t slots) const {
    return std::min(propose + weigh - 1, std::uint64_t{slots} / 2);
  }
  /// From the beginning of a step to that of the next.
  std::uint64_t step(const ImhRegisters& r, const ImhLanes& lanes = {}) const {
    if (!lanes.overlapped) return decided(r, lanes);
    return lanes.rows(r) + propose + weigh - 1 - restricted(r.particles / lanes.count);
  }
};

/// Independent Metropolis-Hastings over proposals from the mixture of the parents, in integers.
///
///   j = 0 .. Q / lanes + N_b - 1 in every lane:  slot = floor(u N / (2^24 lanes)),  x' = propose(x_slot),
///   lw' = weigh(x');  accept  iff  j = 0  or  lw <= lw' + drop;   the last N / lanes states of each chain are the next
///   parents
///
/// One chain before several lanes (folded) goes through row after row, lane after lane, and keeps its last N states.
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
  std::uint64_t decide(unsigned chain);
  std::uint32_t slots_of_row(std::size_t row) const;
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

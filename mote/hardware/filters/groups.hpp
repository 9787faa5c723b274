#pragma once
/// The golden model of rtl/filters/mote_groups.sv: the same integers, and the same cycles.

#include <cstdint>
#include <vector>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/pace.hpp"
#include "mote/hardware/filters/resampler.hpp"

namespace mote::hardware {

/// The parallel particle filter: each lane resamples its own group, every step; M children of each, evenly spread, have
/// the parents that the group before it in the ring has drawn for its own. Words go on from run to run.
///
///   child j of n is exchanged  iff  floor((j + 1) M / n + 1/2) > floor(j M / n + 1/2), with floor(n / 2) / n for 1/2
///   mean = sum w x / sum w over all groups, before resampling
///
/// After resampling all particles count the same, as PPF's Alg. 5 has it: a group that explained little is as large as
/// the others, and the exchange brings it back.
///
/// shape   N is a multiple of the groups; particle groups k + l is slot k of group l; 0 <= M <= N / groups
/// cost    about 40 ns a particle and step, besides the arithmetic's own
/// source  PPF, fig. 3.4 (c); Bolic, Djuric & Hong 2005 (local exchange)
class Groups {
 public:
  /// groups: 1, 2, 4 or 8.
  Groups(Arithmetic arithmetic, std::uint64_t seed, unsigned stream, unsigned groups,
         Resampler resampler = Resampler::kSystematic);

  void start(std::uint32_t particles, std::uint32_t exchange);
  Estimate step(Observed observed);

  /// The set of a step before resampling, a column a state.
  const Particles& set() const { return set_; }
  /// Cycles from start_i to the last estimate, with streams that never wait.
  std::uint64_t cycles() const { return pace_.left(); }

 private:
  /// A group's weights at its own scale, and what it draws its parents by.
  struct Group {
    ResamplerWords resampler;
    std::vector<ScaledWeight> weights = {};
    std::uint64_t total = 0;
  };
  void choose_parents();
  void take_parents(std::size_t child, bool exchanged, std::span<const std::uint32_t> parents);
  void draw_words();
  void weigh_groups();
  Estimate infer();
  void keep_time();

  Arithmetic arithmetic_;
  std::vector<Group> groups_;
  std::vector<Words> draw_words_;  // group after group
  std::uint32_t exchange_ = 0;
  unsigned t_ = 0;
  Particles set_, parents_;
  WordColumns words_;
  std::vector<std::int64_t> log_weights_;
  std::vector<ScaledWeight> weights_;            ///< at the scale of all groups
  std::vector<std::uint64_t> issued_, written_;  ///< cycles, of slots
  Pace pace_;
};

}  // namespace mote::hardware

#pragma once
/// The golden model of rtl/filters/mote_sisr.sv: the same integers, and the same cycles.

#include <cstdint>
#include <optional>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/pace.hpp"
#include "mote/hardware/filters/resampler.hpp"

namespace mote::hardware {

/// The loops of a filter that does one thing after the other, rtl/filters/mote_sisr_plain.sv.
struct PlainLoops {
  bool pipelined = false;  ///< turns of a loop follow each other cycle by cycle; else each waits for the one before
  bool merged = false;     ///< propagating, weighing and normalising are one loop
};

/// The bootstrap filter with resampling every step, in integers; words go on from run to run.
///
/// shape   N is a multiple of the lanes; particle lanes k + l is slot k of lane l
/// cost    about 40 ns a particle and step, besides the arithmetic's own
/// source  FPGA (merged loops, dataflow); Kitagawa 1996
class Sisr {
 public:
  /// lanes: 1, 2, 4 or 8; several of them resample systematically.
  Sisr(Arithmetic arithmetic, std::uint64_t seed, unsigned stream = 0, unsigned lanes = 1,
       Resampler resampler = Resampler::kSystematic);
  /// The same in loops one after the other: other cycles, not another number.
  Sisr(Arithmetic arithmetic, std::uint64_t seed, unsigned stream, PlainLoops loops,
       Resampler resampler = Resampler::kSystematic);

  void start(std::uint32_t particles);
  Estimate step(Observed observed);

  /// The set of a step before resampling, a column a state.
  const Particles& set() const { return set_; }
  /// Cycles from start_i to the last estimate, with streams that never wait.
  std::uint64_t cycles() const { return pace_.left(); }

 private:
  bool in_turn(std::uint64_t cycle) const;
  std::vector<std::uint32_t> walk_beside(ParentWalk& walk);
  std::vector<std::uint32_t> walk_last(ParentWalk& walk);
  void choose_parents();
  Estimate infer();
  void keep_time();
  void keep_loops_time();

  Arithmetic arithmetic_;
  unsigned lanes_;
  std::optional<PlainLoops> loops_;
  ResamplerWords resampler_;
  std::vector<Words> draw_words_;  // lane after lane
  unsigned t_ = 0;
  Particles set_, parents_;
  WordColumns words_;
  std::vector<std::int64_t> log_weights_;
  std::vector<ScaledWeight> weights_;
  std::uint64_t total_ = 0;
  std::vector<std::uint64_t> issued_, written_;  ///< cycles, of slots
  Pace pace_;
};

}  // namespace mote::hardware

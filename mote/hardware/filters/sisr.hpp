#pragma once
/// The golden model of rtl/filters/mote_sisr.sv: the same integers, and the same cycles.

#include <cstdint>

#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/pace.hpp"
#include "mote/hardware/filters/systematic.hpp"
#include "mote/hardware/filters/words.hpp"

namespace mote::hardware {

/// The bootstrap filter with systematic resampling every step, in integers; words go on from run to run.
///
/// cost    about 40 ns a particle and step, besides the arithmetic's own
/// source  FPGA (merged loops, dataflow); Kitagawa 1996
class Sisr {
 public:
  Sisr(Arithmetic arithmetic, std::uint64_t seed, unsigned stream = 0);

  void start(std::uint32_t particles);
  Estimate step(Observed observed);

  /// The set of a step before resampling, a column a state.
  const Particles& set() const { return set_; }
  /// Cycles from start_i to the last estimate, with streams that never wait.
  std::uint64_t cycles() const { return pace_.left(); }

 private:
  void choose_parents();
  Estimate infer();
  void keep_time();

  Arithmetic arithmetic_;
  Words resample_words_;
  std::vector<Words> draw_words_;
  unsigned t_ = 0;
  Particles set_, parents_;
  WordColumns words_;
  std::vector<std::int64_t> log_weights_;
  std::vector<ScaledWeight> weights_;
  std::uint64_t total_ = 0;
  std::uint32_t uniform_ = 0;
  std::vector<std::uint64_t> issued_, written_;  ///< cycles
  Pace pace_;
};

}  // namespace mote::hardware

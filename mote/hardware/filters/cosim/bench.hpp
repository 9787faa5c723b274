#pragma once
/// A bench for verilated filter circuits: drives their streams, with pauses by chance if asked, and notes what comes
/// out.

#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include <verilated.h>

#include "mote/hardware/filters/estimate.hpp"

namespace mote::hardware::cosim {

/// An observation as the circuit's word, and as the golden model's integers.
struct Sight {
  std::uint64_t word = 0;
  std::vector<std::int64_t> values;
};

/// What a run of a circuit gave.
struct Outcome {
  std::vector<Estimate> estimates;
  std::vector<Particles> sets;  ///< what was written to the particle memory, step by step
  std::uint64_t cycles = 0;     ///< from start_i to the last estimate
  bool complete = false;
};

/// How often streams pause, in 256ths.
struct Pauses {
  unsigned observations = 0, estimates = 0;
  std::uint64_t seed = 1;
};

/// The `width` bits of a port from `at` on, as a signed number.
template <class Port>
std::int64_t signed_field(const Port& port, unsigned at, unsigned width) {
  std::uint64_t bits = 0;
  if constexpr (std::is_integral_v<Port>) {
    bits = std::uint64_t{port} >> at;
  } else {  // 32-bit words
    for (unsigned word = at / 32; word <= (at + width - 1) / 32; ++word) {
      const int left = static_cast<int>(32 * word) - static_cast<int>(at);
      bits |= left < 0 ? std::uint64_t{port[word]} >> -left : std::uint64_t{port[word]} << left;
    }
  }
  return static_cast<std::int64_t>(bits << (64 - width)) >> (64 - width);
}

template <class Top>
class Bench {
 public:
  explicit Bench(const Formats& formats, unsigned lanes = 1) : formats_(formats), lanes_(lanes) { reset(); }
  ~Bench() { top_.final(); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  Top& top() { return top_; }

  void reset() {
    top_.clk_i = 0;
    top_.rst_ni = 0;
    top_.start_i = 0;
    top_.obs_valid_i = 0;
    top_.est_ready_i = 0;
    top_.eval();
    tick();
    top_.rst_ni = 1;
    top_.eval();
  }

  /// Starts a run by the registers that `write` sets; stops early after `most_cycles`.
  template <class Write>
  Outcome run(std::size_t particles, const std::vector<Sight>& sights, Write&& write, Pauses pauses = {},
              std::uint64_t most_cycles = UINT64_MAX) {
    std::mt19937_64 random(pauses.seed);
    const auto goes = [&](unsigned pause) { return (random() & 255) >= pause; };
    Outcome outcome;
    std::size_t seen = 0, written = 0;
    write(top_);
    top_.steps_i = static_cast<std::uint16_t>(sights.size());
    top_.start_i = 1;
    bool offers = false;
    for (; outcome.cycles < most_cycles; ++outcome.cycles) {
      offers = seen < sights.size() && (offers || goes(pauses.observations));
      top_.obs_valid_i = offers;
      if (offers) top_.obs_i = static_cast<std::remove_reference_t<decltype(top_.obs_i)>>(sights[seen].word);
      top_.est_ready_i = goes(pauses.estimates);
      top_.eval();
      if (top_.obs_valid_i && top_.obs_ready_o) {
        ++seen;
        offers = false;
      }
      if (top_.kept_valid_o) note_kept(outcome.sets, particles, written++);
      const bool leaves = top_.est_valid_o && top_.est_ready_i;
      if (leaves) note_estimate(outcome.estimates);
      outcome.complete = leaves && top_.est_last_o;
      if (outcome.complete) break;
      tick();
      top_.start_i = 0;
    }
    tick();
    top_.start_i = 0;
    return outcome;
  }

 private:
  void tick() {
    top_.clk_i = 1;
    top_.eval();
    top_.clk_i = 0;
    top_.eval();
  }
  /// Notes a slot of the set, with the states of all lanes.
  void note_kept(std::vector<Particles>& sets, std::size_t particles, std::size_t written) {
    if (written % (particles / lanes_) == 0)
      sets.push_back(Particles(formats_.dims, std::vector<std::int64_t>(particles)));
    for (unsigned lane = 0; lane < lanes_; ++lane)
      for (unsigned d = 0; d < formats_.dims; ++d)
        sets.back()[d].at(std::size_t{top_.kept_slot_o} * lanes_ + lane) =
            signed_field(top_.kept_state_o, (lane * formats_.dims + d) * formats_.value_bits, formats_.value_bits);
  }
  void note_estimate(std::vector<Estimate>& estimates) {
    const unsigned width = formats_.value_bits + formats_.extra_bits + 1;
    Estimate estimate;
    for (unsigned d = 0; d < formats_.dims; ++d)
      estimate.mean.push_back(signed_field(top_.est_mean_o, d * width, width));
    estimate.sum = top_.est_sum_o;
    estimate.scale = signed_field(top_.est_scale_o, 0, formats_.log_bits - 12);
    if constexpr (requires { top_.est_accepted_o; }) estimate.accepted = top_.est_accepted_o;
    estimates.push_back(estimate);
  }

  Formats formats_;
  unsigned lanes_;
  Top top_;
};

}  // namespace mote::hardware::cosim

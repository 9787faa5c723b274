#pragma once
/// Co-simulation of a whole filter circuit: compiled by Verilator, its streams driven, held to its golden model.

#include <cstdint>
#include <vector>

#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/machine/activity.hpp"
#include "mote/hardware/machine/machine.hpp"

namespace mote::hardware {

/// How often streams pause by chance, in 256ths.
struct StreamPauses {
  unsigned observations = 0, estimates = 0;
  std::uint64_t seed = 1;
};

/// What a run of a circuit gave.
struct CircuitRun {
  std::vector<Estimate> estimates;
  std::vector<Particles> sets;  ///< what was written to the particle memory, step by step
  std::uint64_t cycles = 0;     ///< from start_i to the last estimate
  bool complete = false;
  Activity activity;            ///< where it was counted
  bool answered_wrong = false;  ///< the registers' bus: a word or an answer
};

/// A circuit being simulated; its generators go on from run to run, until a reset.
///
/// cost    building: 10 to 60 s of Verilator and compiler; a cycle: 0.2 to 5 us
/// error   Refusal (kOutsideTool) when Verilator is missing, warns about the circuit (-Wall) or fails
class Simulator {
 public:
  /// counts_changes: of every bit, which takes a few times as long.
  explicit Simulator(const Machine& machine, bool counts_changes = false);
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator(Simulator&&) = delete;
  Simulator& operator=(const Simulator&) = delete;
  Simulator& operator=(Simulator&&) = delete;

  /// One step for each row of observations, as the golden model takes them; ends early after `most_cycles`.
  CircuitRun run(const RunRegisters& registers, const std::vector<std::vector<std::int64_t>>& observed,
                 StreamPauses pauses = {}, std::uint64_t most_cycles = UINT64_MAX);
  void reset();

 private:
  void build();

  const Machine* machine_;
  bool counts_changes_;
  ScratchFolder folder_;
  void* library_ = nullptr;
  void* driver_ = nullptr;
};

/// How a circuit and its golden model compare.
struct Agreement {
  std::uint64_t compared = 0;    ///< words of the particle memory
  std::uint64_t mismatches = 0;  ///< such words, estimates and registers' answers that differ or are missing
  std::uint64_t cycles = 0;
  std::uint64_t predicted_cycles = 0;  ///< by the golden model, for streams that never wait
};

/// Runs the golden model on the same observations and compares what came out.
Agreement agreement(const CircuitRun& run, Golden& golden, const RunRegisters& registers,
                    const std::vector<std::vector<std::int64_t>>& observed);

}  // namespace mote::hardware

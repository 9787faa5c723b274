#pragma once
/// A recording through a circuit: simulated clock by clock, compared with its golden model, in the model's units.

#include "mote/app/circuits/circuit.hpp"
#include "mote/engine/run_record.hpp"
#include "mote/hardware/machine/simulator.hpp"

namespace mote {

/// What came of a recording.
struct CircuitSimulation {
  hardware::Agreement agreement;
  hardware::Activity activity;
  RunRecord record;  ///< means, evidence and acceptance; no deviations, no effective sample sizes
};

/// The rows of a recording as a circuit takes them: one a step, also where nothing was seen.
///
/// error   Refusal (kBadData) naming the data: several rows for one step, or more than 65535 steps
std::vector<std::vector<std::int64_t>> observed_by(const FilterCircuit& circuit, const Recording& recording,
                                                   const std::string& where);

/// A circuit's instances as programs.
using Simulators = std::vector<std::unique_ptr<hardware::Simulator>>;

/// Compiles them; counts_changes: of every bit, for an estimate of power, which takes a few times as long.
///
/// error   Refusal (kOutsideTool) when Verilator is missing or fails
Simulators simulators_of(const FilterCircuit& circuit, const CircuitDesign& design, bool counts_changes = false);

/// Simulates a recording, by programs that have run nothing before.
///
/// error   as observed_by()
CircuitSimulation simulated_run(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                                const std::string& where, const Simulators& simulators);

/// The golden model's run of a recording by the design's seed, without a simulation: what the circuit would give.
RunRecord golden_run(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                     const std::string& where);

/// Cycles of such a run by the golden model's count, which is the circuit's own.
std::uint64_t golden_cycles(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                            const std::string& where);

/// The estimates as CSV: t, the mean of every state, log_evidence, and acceptance where a chain decides.
std::string circuit_estimates_csv(const RunRecord& record, bool chain);

}  // namespace mote

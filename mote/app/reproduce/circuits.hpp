#pragma once
/// Circuits: runs of an item that a circuit filters.

#include <optional>
#include <string>

#include "mote/app/circuits/report.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// One circuit at work: its golden model filters, which gives the circuit's numbers; Verilator and Yosys are called for
/// figures alone.
class CircuitBench {
 public:
  /// error   Refusal (kWrongUse) naming file:line for options that `mote rtl` does not have
  CircuitBench(const Run& run, const Job& job);

  /// Why a comparison's figure cannot be had: the tool for it is not there. Empty if it is.
  std::string missing(const Comparison& comparison) const;
  RunRecord record(const Recording& recording, std::uint64_t seed_offset);
  /// What a comparison asks for, one of kCircuitKeys, on a recording.
  double figure(const Comparison& comparison, const Recording& recording);
  /// Cycles of a step of IMH: simulated, from runs of all steps and of the first alone; by the law for one proposal a
  /// cycle in each lane.
  double step_cycles(const Recording& recording);
  double law_cycles();

 private:
  const FilterCircuit& circuit();
  const CircuitReport& report(const Recording& recording);

  std::string where_;
  Job job_;
  CircuitDesign design_;
  std::optional<hardware::Family> family_;
  std::optional<FilterCircuit> circuit_;
  std::optional<CircuitReport> found_;
};

}  // namespace mote::reproduce

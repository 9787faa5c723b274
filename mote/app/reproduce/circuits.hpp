#pragma once
/// Circuits: runs of an item that a circuit filters.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mote/app/circuits/report.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// What the figures of a circuit take of tools.
struct Tools {
  bool simulation = false;  ///< Verilator
  bool synthesis = false;   ///< Yosys
  bool sta = false;         ///< a newer Yosys
};

/// One circuit at work: its golden model filters, which gives the circuit's numbers; Verilator and Yosys are called for
/// figures alone, once each.
class CircuitBench {
 public:
  /// error   Refusal (kWrongUse) naming file:line for options that `mote rtl` does not have
  CircuitBench(const Run& run, const Job& job);

  Tools needed(const Comparison& comparison) const;
  /// Why a comparison's figure cannot be had: the tool for it is not there. Empty if it is.
  std::string missing(const Comparison& comparison) const;
  /// Runs of these tools, which may go side by side; figures that ask for them come at once afterwards.
  std::vector<std::function<void()>> errands(const Tools& tools, const Recording& recording);
  RunRecord record(const Recording& recording, std::uint64_t seed_offset);
  /// What a comparison asks for, one of kCircuitKeys, on a recording.
  double figure(const Comparison& comparison, const Recording& recording);
  /// Cycles of a step of IMH: simulated, from runs of all steps and of the first alone; by the law for a proposal in
  /// each lane every K cycles.
  double step_cycles(const Recording& recording);
  double law_cycles();

 private:
  const FilterCircuit& circuit();
  const CircuitSimulation& simulation(const Recording& recording);
  hardware::Cost cost();
  double sta();

  std::string where_;
  Job job_;
  CircuitDesign design_;
  std::optional<hardware::Family> family_;
  std::optional<FilterCircuit> circuit_;
  Simulators simulators_;
  std::optional<CircuitSimulation> simulation_;
};

}  // namespace mote::reproduce

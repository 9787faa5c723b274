#pragma once
/// What was found out about a circuit: as JSON, as text for a terminal, as a page.

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/circuits/simulation.hpp"
#include "mote/hardware/machine/cost.hpp"
#include "mote/report/page.hpp"

namespace mote {

struct CircuitReport {
  std::string model, command;
  CircuitDesign design;
  std::optional<hardware::Cost> cost;
  std::optional<CircuitSimulation> simulation;
  std::optional<Summary> summary;  ///< of a simulation that has a truth

  /// Of the simulated run, at the clock that was found.
  std::optional<double> milliseconds() const;
  /// Of a step of it, by the estimate of power.
  std::optional<double> microjoules_per_step() const;
};

/// {cycles, predicted_cycles, compared, mismatches, lut, ff, dsp, bram18, iob, fmax_mhz, sta_ns, device, rmse,
/// power_mw, switching, uj_per_step, stages, milliseconds}; what was not asked for is null.
nlohmann::json circuit_json(const FilterCircuit& circuit, const CircuitReport& found);

/// Of them what a device takes: {lut, ff, dsp, bram18, iob, fmax_mhz, sta_ns, device, power_mw}.
nlohmann::json cost_json(const std::optional<hardware::Cost>& cost);

/// Device, area and clock, in words.
void append_cost(std::vector<report::Fact>& facts, const hardware::Cost& cost);

/// Name and value of every figure, in words.
std::vector<report::Fact> circuit_facts(const FilterCircuit& circuit, const CircuitReport& found);

std::string circuit_text(const FilterCircuit& circuit, const CircuitReport& found);

/// One HTML file.
std::string circuit_page(const FilterCircuit& circuit, const CircuitReport& found);

}  // namespace mote

#include "mote/app/reproduce/circuits.hpp"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/circuits/instances.hpp"
#include "mote/app/commands/rtl_options.hpp"
#include "mote/engine/latency.hpp"
#include "mote/hardware/newer_yosys.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::reproduce {

CircuitBench::CircuitBench(const Run& run, const Job& job) : where_(run.where), job_(job) {
  const Arguments arguments = arguments_from(run.where, circuit_options(), run.options);
  design_ = circuit_design_from(arguments);
  family_ = family_from(arguments);
}

std::string CircuitBench::missing(const Comparison& c) const {
  if (c.key == "stages" || c.key == "golden_cycles") return "";
  const bool synthesised = family_ && c.mhz == 0;
  for (const auto& [tool, needed] : {std::pair{"verilator", true}, {"yosys", synthesised}})
    if (needed && !hardware::on_path(tool))
      return fmt::format("there is no {0}. Install it: apt-get install {0}.", tool);
  if (c.key == "sta_ns" && !hardware::NewerYosys::found())
    return fmt::format("there is no Yosys that has sta. Install it: {}.", hardware::kInstallNewerYosys);
  return "";
}

const FilterCircuit& CircuitBench::circuit() {
  if (!circuit_) circuit_ = filter_circuit(job_.model, job_.model_name, design_);
  return *circuit_;
}

RunRecord CircuitBench::record(const Recording& recording, std::uint64_t seed_offset) {
  CircuitDesign design = design_;
  design.seed += seed_offset;
  return golden_run(circuit(), design, recording, where_);
}

double CircuitBench::step_cycles(const Recording& recording) {
  const auto observed =
      observed_by(circuit(), instance_of(circuit().recorded.columns.size(), design_, recording, 0), where_);
  hardware::Simulator simulator(*circuit().machine);
  const auto cycles = [&](std::size_t steps) {
    const auto end = observed.begin() + static_cast<std::ptrdiff_t>(steps);
    return static_cast<double>(simulator.run(design_.registers, {observed.begin(), end}).cycles);
  };
  return (cycles(observed.size()) - cycles(1)) / static_cast<double>(observed.size() - 1);
}

double CircuitBench::law_cycles() {
  const hardware::ImhLanes lanes = design_.architecture->fed(circuit().machine->capacity());
  const hardware::ImhLatency latency(circuit().machine->formats(), lanes);
  const StageLatencies latencies{static_cast<double>(latency.propose), static_cast<double>(latency.weigh)};
  return lanes.folded ? paired_time(design_.registers.draws + design_.registers.burn_in, lanes.count,
                                    {1, 1, 1.0 / lanes.count}, latencies)
                      : sequential_time(lanes.rows(design_.registers), {1, 1, 1}, latencies);
}

const CircuitReport& CircuitBench::report(const Recording& recording) {
  if (!found_) {
    found_ = CircuitReport{job_.model_name, "", design_, {}, simulated_run(circuit(), design_, recording, where_), {}};
    if (family_) found_->cost = times(design_.instances, hardware::cost_of(*circuit().machine, *family_));
  }
  return *found_;
}

double CircuitBench::figure(const Comparison& c, const Recording& recording) {
  if (c.key == "step_cycles_over_law") return step_cycles(recording) / law_cycles();
  if (c.key == "stages") return circuit().machine->stages();
  if (c.key == "golden_cycles") return static_cast<double>(golden_cycles(circuit(), design_, recording, where_));
  const CircuitReport& found = report(recording);
  if (c.mhz > 0) return static_cast<double>(found.simulation->agreement.cycles) / (1000 * c.mhz);
  const nlohmann::json value = circuit_json(circuit(), found)[c.key];
  return value.is_number() ? value.get<double>() : kNaN;
}

}  // namespace mote::reproduce

#include "mote/app/circuits/instances.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "mote/base/filled_in.hpp"
#include "mote/base/refusal.hpp"
#include "mote/hardware/machine/templates.hpp"

namespace mote {
namespace {

using hardware::Machine;
using hardware::Register;

std::string bus(int width, unsigned instances) {
  return fmt::format("[{}:0]", width * static_cast<int>(instances) - 1);
}

std::string register_ports(const Machine& machine) {
  std::string text;
  for (const Register& one : machine.architecture().registers)
    text += fmt::format("    input  logic {}{}_i,\n", one.flag ? "" : fmt::format("[{}:0] ", machine.capacity().at),
                        one.name);
  return text;
}

std::string register_connections(const Machine& machine) {
  std::string text;
  for (const Register& one : machine.architecture().registers) text += fmt::format(".{0}_i({0}_i), ", one.name);
  return text;
}

std::string register_values(const Machine& machine, const hardware::RunRegisters& registers) {
  std::string text;
  for (const Register& one : machine.architecture().registers)
    text += fmt::format(".{}_i({}'d{}), ", one.name, one.flag ? 1 : machine.capacity().at + 1, one.value(registers));
  return text;
}

/// What both texts say of the circuit and its ports.
std::map<std::string, std::string> places_of(const Machine& machine, unsigned instances) {
  const auto slot = static_cast<int>(machine.capacity().slot_bits());
  return {{"name", machine.name()},
          {"instances", std::to_string(instances)},
          {"seed", std::to_string(machine.seed())},
          {"obs_width", std::to_string(machine.observation_bits())},
          {"est_width", std::to_string(machine.estimate_bits())},
          {"slot_width", std::to_string(slot)},
          {"state_width", std::to_string(machine.particle_bits())},
          {"obs", bus(machine.observation_bits(), instances)},
          {"est", bus(machine.estimate_bits(), instances)},
          {"slot", bus(slot, instances)},
          {"state", bus(machine.particle_bits(), instances)},
          {"each", bus(1, instances)}};
}

}  // namespace

std::shared_ptr<const CatalogueModel> model_of_instance(const std::shared_ptr<const CatalogueModel>& model,
                                                        const std::string& name, const CircuitDesign& design) {
  if (design.instances == 1) return model;
  std::shared_ptr<const CatalogueModel> part = model->part();
  if (part && part->states().size() * design.instances == model->states().size()) return part;
  throw Refusal(ExitCode::kWrongUse,
                {design.where, "--instances", fmt::format("a model of {} independent copies", design.instances), name,
                 "Pass ungm with --set copies=2."});
}

Recording instance_of(std::size_t columns, const CircuitDesign& design, const Recording& recording,
                      std::size_t instance) {
  if (design.instances == 1) return recording;
  Recording seen;
  for (const ObservedStep& step : recording.steps) {
    ObservedStep& own = seen.steps.emplace_back(ObservedStep{step.t, {}});
    for (const Row<double>& row : step.rows) {
      Row<double>& part = own.rows.emplace_back();
      for (std::size_t j = instance * columns; j < (instance + 1) * columns; ++j) {
        part.values.push_back(row.values[j]);
        part.present.push_back(row.present[j]);
      }
    }
  }
  return seen;
}

std::uint64_t seed_of_instance(std::uint64_t seed, unsigned instance) { return seed + (std::uint64_t{instance} << 48); }

RunRecord side_by_side(const std::vector<RunRecord>& records, const std::vector<Quantity>& states) {
  RunRecord whole = records.front();
  whole.states = states;
  for (std::size_t k = 0; k < whole.rows.size(); ++k) {
    EstimateRow& row = whole.rows[k];
    for (std::size_t i = 1; i < records.size(); ++i) {
      const EstimateRow& other = records[i].rows[k];
      row.states.insert(row.states.end(), other.states.begin(), other.states.end());
      row.report.log_evidence += other.report.log_evidence;
      row.report.acceptance += other.report.acceptance;
    }
    row.report.acceptance /= static_cast<double>(records.size());
  }
  return whole;
}

hardware::Agreement side_by_side(const std::vector<hardware::Agreement>& all) {
  hardware::Agreement whole = all.front();
  for (std::size_t i = 1; i < all.size(); ++i) {
    whole.compared += all[i].compared;
    whole.mismatches += all[i].mismatches;
    whole.cycles = std::max(whole.cycles, all[i].cycles);
    whole.predicted_cycles = std::max(whole.predicted_cycles, all[i].predicted_cycles);
  }
  return whole;
}

hardware::Cost times(unsigned instances, hardware::Cost cost) {
  if (instances == 1) return cost;
  const auto count = static_cast<int>(instances);
  cost.device += fmt::format("; {} instances", instances);
  for (int* area : {&cost.lut, &cost.ff, &cost.dsp, &cost.bram18}) *area *= count;
  if (cost.power_mw) {
    const double standing = hardware::power_mw({}, 0);
    *cost.power_mw = standing + instances * (*cost.power_mw - standing);
  }
  return cost;
}

std::string module_of_instances(const Machine& machine, unsigned instances) {
  auto places = places_of(machine, instances);
  places["register_ports"] = register_ports(machine);
  places["register_connections"] = register_connections(machine);
  return filled_in(hardware::machine_template("instances.sv.in"), places);
}

std::string testbench_of_instances(const Machine& machine, const CircuitDesign& design, std::size_t steps,
                                   std::size_t kept, std::uint64_t most_cycles) {
  auto places = places_of(machine, design.instances);
  places["registers"] = register_values(machine, design.registers);
  places["steps"] = std::to_string(steps);
  places["kept"] = std::to_string(kept);
  places["most_cycles"] = std::to_string(most_cycles);
  return filled_in(hardware::machine_template("testbench_instances.sv.in"), places);
}

}  // namespace mote

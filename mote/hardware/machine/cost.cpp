#include "mote/hardware/machine/cost.hpp"

#include <algorithm>

#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/filters/weights.hpp"
#include "mote/hardware/timing.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

constexpr double kWireShare = 0.5;  // of a path's time in 7-series designs that are placed well

std::string short_number(double value) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 3);
}

int as_int(unsigned number) { return static_cast<int>(number); }

/// The filter alone, the model's pipelines cut off.
Circuit filter_alone(const Machine& machine) {
  const Formats& f = machine.formats();
  const Architecture& architecture = machine.architecture();
  const int at = as_int(machine.capacity().at);
  const int state = machine.particle_bits();
  const int lanes = as_int(machine.capacity().lanes);
  const int pair = state + lanes * as_int(f.carried * f.value_bits);
  Circuit circuit{std::string(architecture.module), machine.parameters(), {{"start_i"}, {"steps_i", 16}}, {}, 0, true,
                  machine.filter_tables()};
  for (const Register& one : architecture.registers)
    circuit.inputs.push_back({std::string(one.name) + "_i", one.flag ? 1 : at + 1});
  for (const Port& port :
       {Port{"obs_valid_i"}, Port{"obs_i", machine.model().observed_bits()}, Port{"propose_state_i", pair},
        Port{"weigh_log_i", lanes * as_int(f.log_bits)}, Port{"est_ready_i"}})
    circuit.inputs.push_back(port);
  circuit.outputs = {{"busy_o"},
                     {"obs_ready_o"},
                     {"propose_state_o", state},
                     {"propose_words_o", lanes * as_int(32 * f.draw_words)},
                     {"est_valid_o"},
                     {"est_mean_o", as_int(f.dims * (f.value_bits + f.extra_bits + 1))},
                     {"est_sum_o", as_int(f.weight_bits) + at}};
  return circuit;
}

void write_machine(const Machine& machine, const std::string& folder) {
  for (const DesignFile& file : machine.modules(folder)) write_text(folder + file.name, file.text);
  for (const DesignFile& file : machine.tables()) write_text(folder + file.name, file.text);
}

Cost xc7_cost(const Machine& machine, const std::string& folder) {
  const std::string netlist = folder + "netlist.json";
  const Area area = xc7_area(cells_after(folder, xc7_script(machine.name()) + "; write_json " + netlist));
  const SlowestPath path = slowest_path(read_text(netlist), machine.name());
  const double mhz = 1000 * (1 - kWireShare) / path.ns;
  return {"XC7A100T-1 after synthesis; slowest path " + short_number(path.ns) + " ns of cells (" + path.cells + ")",
          area.lut,
          area.ff,
          area.dsp,
          area.bram18,
          mhz,
          power_mw(area, mhz)};
}

Cost ice40_cost(const Machine& machine, const std::string& folder) {
  const auto cells = cells_after(folder, "synth_ice40 -top " + machine.name());
  Cost cost{"iCE40 HX8K, blocks placed and routed, seed 1",
            total(cells, {"SB_LUT4"}),
            total(cells, {"SB_DFF"}),
            total(cells, {"SB_MAC16"}),
            (total(cells, {"SB_RAM40_4K"}) * 4 + 17) / 18,
            {},
            {}};
  double slowest = ice40_routed(filter_alone(machine)).mhz;
  for (const Circuit* pipeline : {&machine.model().propose, &machine.model().weigh})
    slowest = std::min(slowest, ice40_routed(*pipeline).mhz);
  cost.fmax_mhz = slowest;
  return cost;
}

Cost ecp5_cost(const Machine& machine, const std::string& folder) {
  const auto cells = cells_after(folder, "synth_ecp5 -top " + machine.name());
  return {"ECP5, after synthesis",
          total(cells, {"LUT4"}) + 2 * total(cells, {"CCU2C"}),
          total(cells, {"TRELLIS_FF"}),
          total(cells, {"MULT18X18D"}),
          total(cells, {"DP16KD"}),
          {},
          {}};
}

}  // namespace

Cost cost_of(const Machine& machine, Family family) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_machine(machine, folder);
  switch (family) {
    case Family::kXc7:
      return xc7_cost(machine, folder);
    case Family::kIce40:
      return ice40_cost(machine, folder);
    default:
      return ecp5_cost(machine, folder);
  }
}

double power_mw(const Area& area, double mhz) {
  const double microwatts_a_mhz = 0.04 * area.lut + 0.015 * area.ff + 20.0 * area.dsp + 20.0 * area.bram18;
  return 82 + mhz * microwatts_a_mhz / 1000;
}

}  // namespace mote::hardware

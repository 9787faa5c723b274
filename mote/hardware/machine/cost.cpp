#include "mote/hardware/machine/cost.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/bench.hpp"
#include "mote/hardware/filters/weights.hpp"
#include "mote/hardware/newer_yosys.hpp"
#include "mote/hardware/timing.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

constexpr double kWireShare = 0.5;  // of a path's time in 7-series designs that are placed well

double clock_of_path(double ns) { return 1000 * (1 - kWireShare) / ns; }

std::string short_number(double value) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 3);
}

int as_int(unsigned number) { return static_cast<int>(number); }

/// Writes a circuit to a folder; it seeks its tables in `tables`.
template <class Design>
void write_design(const Design& design, const std::string& folder, const std::string& tables) {
  for (const DesignFile& file : design.modules(tables)) write_text(folder + file.name, file.text);
  for (const DesignFile& file : design.tables()) write_text(folder + file.name, file.text);
}

std::string top_of(const Machine& machine) { return machine.top_name(); }
std::string top_of(const Accelerator& accelerator) { return accelerator.name; }

/// The slowest path by the command sta of a newer Yosys.
template <class Design>
double yosys_sta(const Design& design, const NewerYosys& yosys) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_design(design, folder, "");  // it sees its folder and no other
  std::string files;
  for (const DesignFile& file : design.modules("")) files += " " + file.name;
  const std::string said =
      yosys.run(folder, "read_verilog -sv -defer" + files + "; synth_xilinx -family xc7 -flatten -noiopad -abc9 -top " +
                            top_of(design) + "; read_verilog -lib -specify +/xilinx/cells_sim.v; sta");
  const std::size_t line = said.rfind("Latest arrival time");
  const std::size_t colon = line == std::string::npos ? line : said.find("' is ", line);
  if (colon == std::string::npos)
    throw Refusal(ExitCode::kOutsideTool, {"yosys", "sta", "a latest arrival time", "none",
                                           "Install another: " + std::string(kInstallNewerYosys)});
  return std::stod(said.substr(colon + 5)) / 1000;
}

/// The area and the slowest path of a module in a folder.
std::pair<Area, SlowestPath> synthesised(const std::string& folder, const std::string& top) {
  const std::string netlist = folder + "netlist.json";
  const Area area = xc7_area(cells_after(folder, xc7_script(top) + "; write_json " + netlist));
  return {area, slowest_path(read_text(netlist), top)};
}

/// Area, clock and, beside them, the time by sta.
template <class Design>
Cost xc7_cost(const Design& design, const std::string& folder, const Activity& activity, bool with_sta) {
  const auto newer = with_sta ? NewerYosys::found() : std::nullopt;
  std::future<double> sta;
  if (newer) sta = std::async(std::launch::async, [&] { return yosys_sta(design, *newer); });
  const auto [area, path] = synthesised(folder, top_of(design));
  Cost cost{"XC7A100T-1 after synthesis; slowest path " + short_number(path.ns) + " ns of cells (" + path.cells + ")",
            area.lut, area.ff, area.dsp, area.bram18};
  cost.fmax_mhz = clock_of_path(path.ns);
  if (newer)
    cost.sta_ns = sta.get();
  else if (with_sta)
    cost.no_sta = std::string("Debian's Yosys has no sta: ") + kInstallNewerYosys;
  cost.power_mw = power_mw(area, *cost.fmax_mhz, activity);
  return cost;
}

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

Cost ice40_cost(const Machine& machine, const std::string& folder) {
  const auto cells = cells_after(folder, "synth_ice40 -top " + machine.top_name());
  Cost cost{"iCE40 HX8K, blocks placed and routed, seed 1", total(cells, {"SB_LUT4"}), total(cells, {"SB_DFF"}),
            total(cells, {"SB_MAC16"}), (total(cells, {"SB_RAM40_4K"}) * 4 + 17) / 18};
  double slowest = ice40_routed(filter_alone(machine)).mhz;
  for (const Circuit* pipeline : {&machine.model().propose, &machine.model().weigh})
    slowest = std::min(slowest, ice40_routed(*pipeline).mhz);
  cost.fmax_mhz = slowest;
  return cost;
}

/// The whole circuit as an instance in a larger one; its own modules come along.
Circuit whole(const Machine& machine, const std::string& folder) {
  Circuit circuit{machine.top_name(), {}, machine.inputs(), machine.outputs(), 0, true};
  for (const DesignFile& file : machine.modules(folder))
    circuit.sources.push_back({file.name.substr(0, file.name.size() - 3), file.text, ""});
  return circuit;
}

Cost ecp5_cost(const Machine& machine, const std::string& folder) {
  const auto cells = cells_after(folder, "synth_ecp5 -top " + machine.top_name());
  const bool routes = on_path("nextpnr-ecp5");
  Cost cost{routes ? "ECP5-25F, speed grade 6, placed and routed, seed 1" : "ECP5, after synthesis",
            total(cells, {"LUT4"}) + 2 * total(cells, {"CCU2C"}), total(cells, {"TRELLIS_FF"}),
            total(cells, {"MULT18X18D"}), total(cells, {"DP16KD"})};
  if (routes) cost.fmax_mhz = ecp5_routed(whole(machine, folder)).mhz;
  return cost;
}

}  // namespace

PartCost part_cost(const Circuit& circuit) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_bench(folder, "core", {circuit});
  const auto [area, path] = synthesised(folder, "core");
  return {area, path.ns};
}

PartCost part_cost(const Machine& machine) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_design(machine, folder, folder);
  const auto [area, path] = synthesised(folder, machine.top_name());
  return {area, path.ns};
}

Cost cost_of_parts(const PartCost& anchor, unsigned lanes, const PipelineCosts& anchors, const PipelineCosts& own) {
  const auto with_own = [&](int Area::*count) {
    return anchor.area.*count + as_int(lanes) * (own.propose.area.*count + own.weigh.area.*count -
                                                 anchors.propose.area.*count - anchors.weigh.area.*count);
  };
  const Area area{with_own(&Area::lut), with_own(&Area::ff), with_own(&Area::dsp), with_own(&Area::bram18)};
  Cost cost{"XC7A100T-1 by parts after synthesis", area.lut, area.ff, area.dsp, area.bram18};
  cost.fmax_mhz = clock_of_path(std::max({anchor.path_ns, own.propose.path_ns, own.weigh.path_ns}));
  cost.power_mw = power_mw(area, *cost.fmax_mhz);
  return cost;
}

std::optional<double> sta_ns(const Machine& machine) {
  const auto newer = NewerYosys::found();
  return newer ? std::optional(yosys_sta(machine, *newer)) : std::nullopt;
}

Cost cost_of(const Machine& machine, Family family, const Activity& activity, bool with_sta) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_design(machine, folder, folder);
  Cost cost = family == Family::kXc7     ? xc7_cost(machine, folder, activity, with_sta)
              : family == Family::kIce40 ? ice40_cost(machine, folder)
                                         : ecp5_cost(machine, folder);
  cost.iob = machine.pins();
  return cost;
}

Cost cost_of(const Accelerator& accelerator) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_design(accelerator, folder, folder);
  Cost cost = xc7_cost(accelerator, folder, {}, true);
  cost.iob = accelerator.pins();
  return cost;
}

double power_mw(const Area& area, double mhz, const Activity& activity) {
  const double microwatts_a_mhz = activity.fabric / kUsualActivity * (0.04 * area.lut + 0.015 * area.ff) +
                                  activity.products / kUsualActivity * 20.0 * area.dsp + 20.0 * area.bram18;
  return 82 + mhz * microwatts_a_mhz / 1000;
}

}  // namespace mote::hardware

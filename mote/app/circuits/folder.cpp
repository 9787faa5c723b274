#include "mote/app/circuits/folder.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/circuits/instances.hpp"
#include "mote/base/filled_in.hpp"
#include "mote/base/refusal.hpp"
#include "mote/hardware/machine/bits.hpp"
#include "mote/hardware/machine/c_library.hpp"
#include "mote/hardware/machine/templates.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "circuit.json";  // only designs have one

/// What the golden model makes of a recording, as a testbench compares it.
struct Vectors {
  std::string observations, estimates, particles;
  std::size_t steps = 0, kept = 0;
  std::uint64_t cycles = 0;
};

std::vector<std::uint32_t> estimate_words(const hardware::Machine& machine, const hardware::Estimate& estimate) {
  hardware::BitWriter bits(machine.estimate_bits());
  std::vector<std::int64_t> parts = estimate.mean;
  parts.push_back(static_cast<std::int64_t>(estimate.sum));
  parts.push_back(estimate.scale);
  parts.push_back(static_cast<std::int64_t>(estimate.accepted));
  const auto fields = machine.estimate_fields();
  for (std::size_t k = 0; k < fields.size(); ++k) bits.append(parts[k], fields[k].format.width());
  return bits.words();
}

/// A line for every write: the particles of a slot, a lane each, and the slot above them.
void append_particles(Vectors& vectors, const hardware::Machine& machine, const hardware::Particles& set) {
  const auto value_bits = static_cast<int>(machine.formats().value_bits);
  const auto slot_bits = static_cast<int>(machine.capacity().slot_bits());
  const std::size_t lanes = machine.capacity().lanes;
  for (std::size_t slot = 0; slot < set[0].size() / lanes; ++slot, ++vectors.kept) {
    hardware::BitWriter bits(machine.particle_bits() + slot_bits);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (const auto& state : set) bits.append(state[slot * lanes + lane], value_bits);
    bits.append(static_cast<std::int64_t>(slot), slot_bits);
    vectors.particles += hex_of(bits.words());
  }
}

Vectors vectors_of(const FilterCircuit& circuit, const CircuitDesign& design, unsigned instance,
                   const Recording& played, const std::string& where) {
  const hardware::Machine& machine = circuit.instance(instance);
  const auto golden = machine.golden();
  golden->start(design.registers);
  Vectors vectors;
  for (const auto& observed : observed_by(circuit, played, where)) {
    vectors.observations += hex_of(machine.observation_words(observed));
    vectors.estimates += hex_of(estimate_words(machine, golden->step(observed)));
    append_particles(vectors, machine, golden->set());
    ++vectors.steps;
  }
  vectors.cycles = golden->cycles();
  return vectors;
}

std::string literal_of(const hardware::Register& one, const hardware::RunRegisters& registers) {
  return one.flag ? fmt::format("1'b{}", one.value(registers)) : fmt::format("{}", one.value(registers));
}

/// How a testbench reaches the registers: what it declares, connects and does to start a run.
struct RegisterBench {
  std::string declared, connections, start;
};

RegisterBench port_bench(const hardware::Architecture& architecture, const hardware::RunRegisters& registers) {
  RegisterBench bench{"  logic start = 1'b0, busy;\n", ".start_i(start), .steps_i(16'(Steps)), ",
                      "    start <= 1'b1;\n    @(posedge clk);\n    start <= 1'b0;\n"};
  for (const hardware::Register& one : architecture.registers)
    bench.connections += fmt::format(".{}_i({}), ", one.name, literal_of(one, registers));
  bench.connections += ".busy_o(busy),";
  return bench;
}

RegisterBench bus_bench(const hardware::Machine& machine, const hardware::RunRegisters& registers) {
  RegisterBench bench{std::string(hardware::machine_template("testbench_axi_lite.sv.in")),
                      std::string(hardware::machine_template("testbench_axi_lite_ports.sv.in")),
                      "    write(4, 32'(Steps));\n"};
  bench.declared = filled_in(bench.declared, {{"address_top", fmt::format("{}", machine.address_bits() - 1)}});
  unsigned address = 8;
  for (const hardware::Register& one : machine.architecture().registers) {
    bench.start += fmt::format("    write({}, 32'd{});\n", address, one.value(registers));
    address += 4;
  }
  bench.start += "    write(0, 32'd1);\n";
  return bench;
}

bool on_bus(const hardware::Machine& machine) { return machine.access() == hardware::RegisterAccess::kAxiLite; }

std::string register_table(const hardware::Machine& machine, const hardware::RunRegisters& registers) {
  const bool bus = on_bus(machine);
  std::string text =
      bus ? "\n| address | register | holds | here |\n|---|---|---|---|\n| 0x00 | `control` | write 1: start; "
            "reads 1 while a run goes on | |\n| 0x04 | `steps` | steps of a run, at most 65535 | |\n"
          : "\n| register | holds | here |\n|---|---|---|\n";
  unsigned address = 8;
  for (const hardware::Register& one : machine.architecture().registers) {
    const std::string name = bus ? fmt::format("0x{:02x} | `{}`", address, one.name) : fmt::format("`{}_i`", one.name);
    text += fmt::format("| {} | {} | {} |\n", name, one.meaning, one.value(registers));
    address += 4;
  }
  return text;
}

std::string how_to_run(bool bus) {
  return bus ? "write the registers by AXI4-Lite, then 1 to address 0; send as many observations as `steps` says, take "
               "as "
               "many estimates. Address 0 reads 0 again behind the last one."
             : "write the registers, raise `start_i` for a clock, send `steps_i` observations, take as many estimates. "
               "`busy_o` falls behind the last one.";
}

std::string figure_table(const FilterCircuit& circuit, const CircuitReport& found) {
  std::string text;
  for (const report::Fact& fact : circuit_facts(circuit, found))
    text += fmt::format("| {} | {} |\n", fact.name, fact.value);
  return text;
}

std::string testbench_of(const hardware::Machine& machine, const CircuitDesign& design, const Vectors& vectors,
                         double period_ns) {
  const RegisterBench bench =
      on_bus(machine) ? bus_bench(machine, design.registers) : port_bench(machine.architecture(), design.registers);
  return filled_in(hardware::machine_template("testbench.sv.in"),
                   {{"top", machine.top_name()},
                    {"steps", fmt::format("{}", vectors.steps)},
                    {"kept", fmt::format("{}", vectors.kept)},
                    {"obs_top", fmt::format("{}", machine.observation_bits() - 1)},
                    {"est_top", fmt::format("{}", machine.estimate_bits() - 1)},
                    {"slot_top", fmt::format("{}", machine.capacity().slot_bits() - 1)},
                    {"state_top", fmt::format("{}", machine.particle_bits() - 1)},
                    {"registers", bench.declared},
                    {"connections", bench.connections},
                    {"start", bench.start},
                    {"half_period", fmt::format("{:.3f}", period_ns / 2)},
                    {"most_cycles", fmt::format("{}", 2 * vectors.cycles + 1000)}});
}

/// The module that holds all instances, and its own testbench in place of one circuit's.
void add_instances(DesignFiles& files, const FilterCircuit& circuit, const CircuitDesign& design,
                   const std::vector<Vectors>& all) {
  const hardware::Machine& machine = *circuit.machine;
  std::uint64_t cycles = 0;
  for (const Vectors& vectors : all) cycles = std::max(cycles, vectors.cycles);
  files[fmt::format("rtl/{}_x{}.sv", machine.name(), design.instances)] =
      module_of_instances(machine, design.instances);
  files["testbench/testbench.sv"] =
      testbench_of_instances(machine, design, all.front().steps, all.front().kept, 2 * cycles + 1000);
  for (const char* name : {"observations", "estimates", "particles"})
    files.erase(fmt::format("testbench/{}.hex", name));
  for (std::size_t i = 0; i < all.size(); ++i) {
    files[fmt::format("testbench/observations{}.hex", i)] = all[i].observations;
    files[fmt::format("testbench/estimates{}.hex", i)] = all[i].estimates;
    files[fmt::format("testbench/particles{}.hex", i)] = all[i].particles;
  }
}

DesignFiles files_of(const FilterCircuit& circuit, const CircuitReport& found, const std::vector<Vectors>& all) {
  const Vectors& vectors = all.front();
  const hardware::Machine& machine = *circuit.machine;
  const double period_ns = 1000 / found.cost.value_or(hardware::Cost{}).fmax_mhz.value_or(100);
  const std::map<std::string, std::string> places{
      {"name", machine.name()},
      {"golden", found.design.instances == 1 ? "golden" : "golden0"},
      {"top", machine.top_name()},
      {"bus_row", on_bus(machine)
                      ? fmt::format("\n| `rtl/{}.sv` | the same with its registers on AXI4-Lite |", machine.top_name())
                      : ""},
      {"run", how_to_run(on_bus(machine))},
      {"model", machine.model().name},
      {"meaning", std::string(machine.architecture().meaning)},
      {"command", found.command},
      {"part", "xc7a100tcsg324-1"},
      {"period", fmt::format("{:.3f}", period_ns)},
      {"figures", figure_table(circuit, found)},
      {"registers", register_table(machine, found.design.registers)},
      {"weight_bits", fmt::format("{}", machine.formats().weight_bits)}};
  const auto filled = [&](const char* name) { return filled_in(hardware::machine_template(name), places); };
  DesignFiles files{{"README.md", filled("README.md.in")},
                    {kMark, circuit_json(circuit, found).dump(2) + "\n"},
                    {machine.name() + ".xdc", filled("constraints.xdc.in")},
                    {"vivado.tcl", filled("vivado.tcl.in")},
                    {"testbench/run.sh", filled("run.sh.in")},
                    {"testbench/testbench.sv", testbench_of(machine, found.design, vectors, period_ns)},
                    {"testbench/observations.hex", vectors.observations},
                    {"testbench/estimates.hex", vectors.estimates},
                    {"testbench/particles.hex", vectors.particles}};
  for (const hardware::DesignFile& file : machine.modules("")) files["rtl/" + file.name] = file.text;
  for (const hardware::DesignFile& file : machine.tables()) files["tables/" + file.name] = file.text;
  for (unsigned i = 0; i < found.design.instances; ++i) {
    const std::string instance = found.design.instances == 1 ? "" : std::to_string(i);
    for (const hardware::DesignFile& file : hardware::c_library(circuit.instance(i), found.design.registers, instance))
      files["golden" + instance + "/" + file.name] = file.text;
  }
  if (found.design.instances > 1) add_instances(files, circuit, found.design, all);
  if (found.simulation)
    files["estimates.csv"] = circuit_estimates_csv(found.simulation->record, machine.architecture().chain);
  return files;
}

/// A folder that another program wrote keeps its files.
void refuse_foreign(const fs::path& folder, const DesignFiles& files) {
  if (fs::exists(folder / kMark)) return;
  for (const auto& [name, text] : files)
    if (fs::exists(folder / name))
      throw Refusal(ExitCode::kCannotWrite, {folder.string(), "", "a new folder, or that of a design",
                                             "a file " + name + " of something else", "Pass another --out."});
}

void make_folders(const fs::path& folder, const DesignFiles& files) {
  for (const auto& [name, text] : files) {
    std::error_code error;
    fs::create_directories((folder / name).parent_path(), error);
    if (error)
      throw Refusal(ExitCode::kCannotWrite,
                    {folder.string(), "", "a folder that can be made", error.message(), "Pass another --out."});
  }
}

}  // namespace

std::string hex_of(const std::vector<std::uint32_t>& words) {
  std::string text;
  for (auto word = words.rbegin(); word != words.rend(); ++word) text += fmt::format("{:08x}", *word);
  return text + '\n';
}

void write_files(OutputSet& outputs, const std::string& folder, const DesignFiles& files) {
  refuse_foreign(folder, files);
  make_folders(folder, files);
  for (const auto& [name, text] : files) outputs.open((fs::path(folder) / name).string())->write(text);
}

void write_design(OutputSet& outputs, const std::string& folder, const FilterCircuit& circuit,
                  const CircuitReport& found, const Recording& played, const std::string& where) {
  std::vector<Vectors> all;
  for (unsigned i = 0; i < found.design.instances; ++i)
    all.push_back(vectors_of(circuit, found.design, i,
                             instance_of(circuit.recorded.columns.size(), found.design, played, i), where));
  write_files(outputs, folder, files_of(circuit, found, all));
}

}  // namespace mote

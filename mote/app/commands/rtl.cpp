#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/catalogue/text_entry.hpp"
#include "mote/app/circuits/folder.hpp"
#include "mote/app/circuits/simulation.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using hardware::Architecture;
using hardware::architectures;

constexpr long long kMostParticles = 65536;

CircuitDesign design_from(const Arguments& arguments) {
  std::vector<std::string> names;
  for (const Architecture& one : architectures()) names.emplace_back(one.name);
  CircuitDesign design;
  design.architecture = &architectures()[arguments.choice("--arch", names)];
  const long long particles = arguments.integer("--particles", 1, kMostParticles);
  design.registers.particles = static_cast<std::uint32_t>(particles);
  design.registers.draws = static_cast<std::uint32_t>(
      arguments.given("--draws") ? arguments.integer("--draws", particles, kMostParticles) : particles);
  design.registers.burn_in = static_cast<std::uint32_t>(arguments.integer("--burn-in", 0, kMostParticles));
  design.registers.chain_mean = arguments.given("--chain-mean");
  design.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  return design;
}

/// Registers that the architecture does not have are no use to be told.
void refuse_unread(const Arguments& arguments, const Architecture& architecture) {
  const std::map<std::string, std::string> registers{
      {"--draws", "draws"}, {"--burn-in", "burn_in"}, {"--chain-mean", "chain_mean"}, {"--lanes", "lanes"}};
  for (const auto& [option, name] : registers)
    if (arguments.given(option) && std::none_of(architecture.registers.begin(), architecture.registers.end(),
                                                [&](const auto& one) { return one.name == name; }))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, "an architecture that has it",
                                          std::string(architecture.name), "Leave it out, or pass another --arch."});
}

/// The model as the recording sizes it; without one as --columns does.
Job job_from(const Arguments& arguments) {
  const std::string model = arguments.text("MODEL");
  if (arguments.given("--simulate"))
    return load_job(model, arguments.text("--simulate"), arguments.text("--truth"), arguments.list("--set"),
                    arguments.where());
  if (arguments.given("--truth"))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--truth", "--simulate, whose estimates it scores",
                                        "nothing", "Pass --simulate obs.csv."});
  Job job;
  job.model_name = model;
  job.model = find_model(model, arguments.where())
                  .make(Settings(arguments.where(), arguments.list("--set")),
                        frame_header(arguments.integer("--columns", 1, 64)));
  return job;
}

std::optional<hardware::Family> family_from(const Arguments& arguments) {
  if (!arguments.given("--synth")) return std::nullopt;
  return static_cast<hardware::Family>(arguments.choice("--synth", {"xc7", "ice40", "ecp5"}));
}

/// Whatever the command reads is not to be written over.
void protect_inputs(OutputSet& outputs, const Arguments& arguments) {
  outputs.protect(arguments.text("--simulate"));
  outputs.protect(arguments.text("--truth"));
  if (is_text_model(arguments.text("MODEL"))) outputs.protect(arguments.text("MODEL"));
  for (const std::string& setting : arguments.list("--set"))
    if (setting.starts_with("file=")) outputs.protect(setting.substr(5));
}

/// What a testbench plays when nothing was recorded.
Recording drawn_recording(const CatalogueModel& model) {
  constexpr Step kSteps = 20;
  return simulated_scene(model, kSteps, 1).recording;
}

ExitCode run_rtl(const Arguments& arguments) {
  const CircuitDesign design = design_from(arguments);
  refuse_unread(arguments, *design.architecture);
  const Job job = job_from(arguments);
  const std::optional<hardware::Family> family = family_from(arguments);
  OutputSet outputs;
  protect_inputs(outputs, arguments);
  Output* json = outputs.open(arguments.text("--json"));
  Output* report = outputs.open(arguments.text("--report"));
  CircuitReport found{job.model_name, arguments.command_line(), design, {}, {}, {}};
  const FilterCircuit circuit = filter_circuit(*job.model, job.model_name, design);
  if (family) found.cost = hardware::cost_of(*circuit.machine, *family);
  if (arguments.given("--simulate"))
    found.simulation = simulated(circuit, design, job.recording, arguments.text("--simulate"));
  if (job.truth) found.summary = summarise(found.simulation->record, &*job.truth);
  if (arguments.given("--out"))
    write_design(outputs, arguments.text("--out"), circuit, found,
                 found.simulation ? job.recording : drawn_recording(*job.model), arguments.text("--simulate"));
  if (json != nullptr) json->write(circuit_json(circuit, found).dump(2) + "\n");
  if (report != nullptr) report->write(circuit_page(circuit, found));
  outputs.commit();
  for (const std::string& note : job.notes) fmt::print(stderr, "{}\n", note);
  if (!outputs.on_standard_output()) fmt::print("{}", circuit_text(circuit, found));
  return ExitCode::kDone;
}

}  // namespace

Command rtl_command() {
  std::string kinds;
  for (const Architecture& one : architectures()) kinds += (kinds.empty() ? "" : ", ") + std::string(one.name);
  return {"rtl",
          "Write a model's filter as a circuit",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
          {{"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Model", true},
           {"--columns", "M", "1", "doa: directions per frame, from 1 to 64; with --simulate the data say", "Model"},
           {"--arch", "KIND", "imh", "kind of filter: " + kinds, "Circuit"},
           {"-n,--particles", "N", "1000", "particles, from 1 to 65536", "Circuit"},
           {"--draws", "Q", "", "imh: proposals a step beside the burn-in, at least N [N]", "Circuit"},
           {"--burn-in", "NB", "0", "imh: proposals that the chain forgets", "Circuit"},
           {"--chain-mean", "", "", "imh: estimate from the kept states instead of all weighted proposals", "Circuit"},
           {"--lanes", "L", "1", "lanes side by side (chains, where there are chains)", "Circuit"},
           {"--seed", "S", "1", "seed of the circuit's generators; same seed, same words", "Circuit"},
           {"--simulate", "FILE", "", "a recording as CSV to simulate clock by clock (Verilator) [none]", "Checks"},
           {"--truth", "FILE", "", "true states as CSV, to score against [none]", "Checks"},
           {"--synth", "FAMILY", "", "what it takes of a device: xc7, ice40 or ecp5 (Yosys, nextpnr) [none]", "Checks"},
           {"--out", "DIR", "", "folder for the design: SystemVerilog, tables, scripts, testbench [none]", "Output"},
           {"--json", "FILE", "", "figures as JSON; - is standard output [none]", "Output"},
           {"--report", "FILE", "", "report, one HTML file [none]", "Output"}},
          run_rtl,
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 5 outside tool, 6 cannot write."};
}

}  // namespace mote

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/catalogue/text_entry.hpp"
#include "mote/app/circuits/folder.hpp"
#include "mote/app/circuits/instances.hpp"
#include "mote/app/circuits/simulation.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/commands/rtl_options.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

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
  const CircuitDesign design = circuit_design_from(arguments);
  const Job job = job_from(arguments);
  const std::optional<hardware::Family> family = family_from(arguments);
  OutputSet outputs;
  protect_inputs(outputs, arguments);
  Output* json = outputs.open(arguments.text("--json"));
  Output* report = outputs.open(arguments.text("--report"));
  CircuitReport found{job.model_name, arguments.command_line(), design, {}, {}, {}};
  const FilterCircuit circuit = filter_circuit(job.model, job.model_name, design);
  if (family) found.cost = times(design.instances, hardware::cost_of(*circuit.machine, *family));
  if (arguments.given("--simulate"))
    found.simulation = simulated_run(circuit, design, job.recording, arguments.text("--simulate"));
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
  std::vector<OptionSpec> options{
      {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Model", true},
      {"--columns", "M", "1", "doa: directions per frame, from 1 to 64; with --simulate the data say", "Model"}};
  for (OptionSpec& option : circuit_options()) options.push_back(std::move(option));
  for (OptionSpec& option : std::vector<OptionSpec>{
           {"--simulate", "FILE", "", "a recording as CSV to simulate clock by clock (Verilator) [none]", "Checks"},
           {"--truth", "FILE", "", "true states as CSV, to score against [none]", "Checks"},
           {"--out", "DIR", "", "folder for the design: SystemVerilog, tables, scripts, testbench [none]", "Output"},
           {"--json", "FILE", "", "figures as JSON; - is standard output [none]", "Output"},
           {"--report", "FILE", "", "report, one HTML file [none]", "Output"}})
    options.push_back(std::move(option));
  return {"rtl",
          "Write a model's filter as a circuit",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
          std::move(options),
          run_rtl,
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 5 outside tool, 6 cannot write."};
}

}  // namespace mote

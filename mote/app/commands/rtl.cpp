#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/circuits/accelerator.hpp"
#include "mote/app/circuits/folder.hpp"
#include "mote/app/circuits/instances.hpp"
#include "mote/app/circuits/simulation.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/inputs.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/commands/rtl_options.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/app/words/study.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

/// The model as the recording sizes it; without one as --columns does. Words are chosen on recordings.
Job job_from(const Arguments& arguments) {
  const std::string model = arguments.required("MODEL", "a model (see mote models), or a .toml file", "Name one.");
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
  if (!can_be_drawn(*job.model))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), model, "laws to draw recordings by, or a recording",
                                        "neither", "Pass --simulate obs.csv, or write laws beside log_likelihood."});
  return job;
}

/// What a testbench plays when nothing was recorded.
Recording drawn_recording(const CatalogueModel& model) {
  constexpr Step kSteps = 20;
  return simulated_scene(model, kSteps, 1).recording;
}

/// A matrix as text: rows by semicolons, numbers by commas.
std::vector<std::vector<double>> covariance_from(const Arguments& arguments) {
  const std::string text = arguments.text("--covariance");
  const auto refuse = [&] {
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--covariance", "a symmetric matrix, rows by semicolons",
                                        '"' + text + '"', "Pass --covariance \"4,1;1,2\"."});
  };
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line, ';');) {
    rows.emplace_back();
    std::istringstream numbers(line);
    for (std::string number; std::getline(numbers, number, ',');) {
      std::size_t read = 0;
      try {
        rows.back().push_back(std::stod(number, &read));
      } catch (const std::exception&) {
        refuse();
      }
      if (read != number.size()) refuse();
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != rows.size()) refuse();
    for (std::size_t j = 0; j < i; ++j)
      if (rows[i][j] != rows[j][i]) refuse();
  }
  if (rows.empty() || rows.size() > 16) refuse();
  return rows;
}

/// What a part of a filter has no use for.
void refuse_for_parts(const Arguments& arguments, const std::string& kind) {
  std::vector<std::string> unread{"--arch",     "--draws", "--burn-in", "--chain-mean", "--lanes", "--registers",
                                  "--simulate", "--truth", "--report",  "--ii",         "--tables"};
  if (kind != "likelihood") unread.insert(unread.end(), {"MODEL", "--set", "--columns", "--more-bits"});
  if (kind != "gaussian") unread.emplace_back("--covariance");
  if (kind == "gaussian") unread.emplace_back("--particles");
  for (const std::string& option : unread)
    if (arguments.given(option))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, "nothing with --accelerator " + kind,
                                          '"' + arguments.text(option) + '"', "Leave it out."});
  if (arguments.given("--synth") && arguments.text("--synth") != "xc7")
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--synth", "xc7 with --accelerator",
                                        arguments.text("--synth"), "Pass --synth xc7."});
}

PlayedAccelerator accelerator_from(const Arguments& arguments, const std::string& kind) {
  const auto seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  if (kind == "gaussian") return played_gaussian(covariance_from(arguments), seed);
  const auto n = static_cast<std::uint32_t>(arguments.integer("--particles", 1, 65536));
  if (kind == "resampler") return played_resampler(n, seed);
  CircuitDesign design = circuit_design_from(arguments);
  const Job job = job_from(arguments);
  return played_likelihood(filter_circuit(job.model, job.model_name, design), design, drawn_recording(*job.model),
                           arguments.where());
}

ExitCode run_accelerator(const Arguments& arguments) {
  const std::vector<std::string> kinds{"gaussian", "likelihood", "resampler"};
  const std::string kind = kinds[arguments.choice("--accelerator", kinds)];
  refuse_for_parts(arguments, kind);
  OutputSet outputs;
  protect_inputs(outputs, arguments, {"--simulate", "--truth"});
  Output* json = outputs.open(arguments.text("--json"));
  const PlayedAccelerator played = accelerator_from(arguments, kind);
  std::optional<hardware::Cost> cost;
  if (arguments.given("--synth")) cost = hardware::cost_of(played.made);
  if (arguments.given("--out"))
    write_accelerator(outputs, arguments.text("--out"), played, cost, arguments.command_line());
  if (json != nullptr) json->write(accelerator_json(cost).dump(2) + "\n");
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", accelerator_text(played.made, cost));
  return ExitCode::kDone;
}

ExitCode run_rtl(const Arguments& arguments) {
  if (arguments.given("--accelerator")) return run_accelerator(arguments);
  if (arguments.given("--covariance"))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--covariance", "--accelerator gaussian", "nothing",
                                        "Pass --accelerator gaussian."});
  const CircuitDesign design = circuit_design_from(arguments);
  const Job job = job_from(arguments);
  const std::optional<hardware::Family> family = family_from(arguments);
  OutputSet outputs;
  protect_inputs(outputs, arguments, {"--simulate", "--truth"});
  Output* json = outputs.open(arguments.text("--json"));
  Output* report = outputs.open(arguments.text("--report"));
  CircuitReport found{job.model_name, arguments.command_line(), design, {}, {}, {}};
  const FilterCircuit circuit = filter_circuit(job.model, job.model_name, design, job.recording);
  if (arguments.given("--simulate"))
    found.simulation = simulated_run(circuit, design, job.recording, arguments.text("--simulate"),
                                     simulators_of(circuit, design, family == hardware::Family::kXc7));
  if (family)
    found.cost = times(design.instances,
                       hardware::cost_of(*circuit.machine, *family,
                                         found.simulation ? found.simulation->activity : hardware::Activity{}));
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
           {"--accelerator", "PART", "",
            "a part by itself between streams: gaussian (no MODEL), likelihood, or resampler (no MODEL) [none]",
            "Circuit"},
           {"--covariance", "ROWS", "1", "gaussian: covariance, rows by semicolons: \"4,1;1,2\"", "Circuit"},
           {"--simulate", "FILE", "", "a recording as CSV to simulate clock by clock (Verilator) [none]", "Checks"},
           {"--truth", "FILE", "", "true states as CSV, to score against [none]", "Checks"},
           {"--out", "DIR", "", "folder for the design: SystemVerilog, tables, scripts, testbench [none]", "Output"},
           {"--json", "FILE", "", "figures as JSON; - is standard output [none]", "Output"},
           {"--report", "FILE", "", "report, one HTML file [none]", "Output"}})
    options.push_back(std::move(option));
  return {"rtl",
          "Write a model's filter as a circuit",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file", false}},
          std::move(options),
          run_rtl,
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 5 outside tool, 6 cannot write."};
}

}  // namespace mote

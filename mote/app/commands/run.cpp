#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/checkpoint_options.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/run_files.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"

namespace mote {
namespace {

void print_summary(const RunRecord& record, const Summary& s) {
  fmt::print("{}  {}  N = {}  seed {}  {} engine\n", record.model, name_of(record.plan.filter), record.plan.particles,
             record.plan.seed, record.engine);
  fmt::print("{} step{} estimated, {} predicted, {:.3g} s, {:.3g} ns per particle and step\n", record.rows.size(),
             record.rows.size() == 1 ? "" : "s", record.predicted_steps, record.wall_seconds, s.ns_per_particle_step);
  fmt::print("log evidence {:.6g}, mean ESS {:.4g}", s.log_evidence, s.mean_ess);
  if (!std::isnan(s.acceptance)) fmt::print(", acceptance {:.3f}", s.acceptance);
  fmt::print("\n");
  if (s.collapses > 0) fmt::print("collapsed at {} steps\n", s.collapses);
  for (std::size_t d = 0; d < s.rmse.size(); ++d)
    if (!std::isnan(s.rmse[d]))
      fmt::print("rmse {} {:.4g} {}\n", record.states[d].name, s.rmse[d], record.states[d].unit);
  if (s.position_error)
    fmt::print("position error: mean {:.4g}, median {:.4g}, rmse {:.4g}\n", s.position_error->mean,
               s.position_error->median, s.position_error->rmse);
}

/// Whatever the command reads is not to be written over.
void protect_inputs(OutputSet& outputs, const Arguments& arguments) {
  outputs.protect(arguments.text("--data"));
  outputs.protect(arguments.text("--truth"));
  for (const std::string& setting : arguments.list("--set"))
    if (setting.starts_with("file=")) outputs.protect(setting.substr(5));
}

ExitCode run_run(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const std::atomic<bool>& stop = stop_flag();
  const Plan plan = plan_from(arguments);
  Job job = load_job(arguments.text("MODEL"),
                     arguments.required("--data", "a CSV file with the recording", "Pass --data obs.csv."),
                     arguments.text("--truth"), arguments.list("--set"), arguments.where());
  job.command = arguments.command_line();
  RunRequest request = request_for(job, arguments.list("--estimate"), arguments.where());
  request.stop = &stop;
  OutputSet outputs;
  protect_inputs(outputs, arguments);
  outputs.reserve(arguments.text("--checkpoint"));
  Output* estimates = outputs.open(arguments.text("--out"));
  Output* summary_file = outputs.open(arguments.text("--summary"));
  Output* report = outputs.open(arguments.text("--report"));
  Output* dump = outputs.open(arguments.text("--dump-particles"));
  if (dump != nullptr) {
    dump->write(particles_header(request.states));
    request.dump = [dump](Step t, const WeightedSet& set) { write_particles(*dump, t, set); };
  }
  std::optional<CheckpointFile> checkpoint = checkpoint_from(arguments, plan, job);
  if (checkpoint) request.checkpoint = &*checkpoint;
  if (checkpoint && checkpoint->found())
    job.notes.push_back(arguments.text("--checkpoint") + ": note: the run goes on from there.");
  for (const std::string& note : notes_on_unread(arguments, plan)) job.notes.push_back(note);
  for (const std::string& note : job.notes) fmt::print(stderr, "{}\n", printable(note));
  RunRecord record;
  {
    Progress progress("steps");
    request.progress = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
    record = run_job(job, plan, request, arguments.where());
  }
  if (record.interrupted)
    throw Refusal(ExitCode::kInterrupted,
                  fmt::format("{}: interrupted after {} of {} steps; {}.", arguments.where(), record.rows.size(),
                              job.recording.steps.size(),
                              checkpoint ? "the same command goes on from " + arguments.text("--checkpoint")
                                         : "no file was written"));
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Summary summary = summarise(record, job.truth ? &*job.truth : nullptr);
  if (estimates != nullptr) estimates->write(estimates_csv(record));
  if (summary_file != nullptr) summary_file->write(summary_json(record, summary).dump(2) + "\n");
  if (report != nullptr) report->write(report_for(job, record, summary));
  outputs.commit();
  if (checkpoint) checkpoint->remove();
  if (!outputs.on_standard_output()) print_summary(record, summary);
  return ExitCode::kDone;
}

}  // namespace

Command run_command() {
  std::vector<OptionSpec> options{
      {"--data", "FILE", "", "recording as CSV: t, then the model's columns; must be given", "Data"},
      {"--truth", "FILE", "", "true states as CSV, to score against [none]", "Data"},
      {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Data", true},
      {"--out", "FILE", "", "estimates as CSV; - is standard output [none]", "Output"},
      {"--summary", "FILE", "", "figures of the run as JSON [none]", "Output"},
      {"--report", "FILE", "", "report with plots, one HTML file [none]", "Output"},
      {"--estimate", "F", "",
       "also estimate F: mean(f), sd(f), median(f), q0.9(f), P(f>1.5); f a state or a function of the model; may be "
       "repeated [none]",
       "Output", true},
      {"--dump-particles", "FILE", "", "weighted particles of every step as CSV [none]", "Output"},
  };
  for (OptionSpec& option : plan_options()) options.push_back(std::move(option));
  for (OptionSpec& option : checkpoint_options()) options.push_back(std::move(option));
  return {"run",
          "Filter a recording",
          {{"MODEL", "a model of the catalogue (see mote models)"}},
          std::move(options),
          run_run,
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 4 collapsed, 5 outside tool, 6 cannot write, 130 interrupted."};
}

}  // namespace mote

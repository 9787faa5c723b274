#include "mote/app/commands/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/budget.hpp"
#include "mote/app/commands/checkpoint_options.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/inputs.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/run_files.hpp"
#include "mote/app/files/team_checkpoint.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/engine/cast.hpp"

namespace mote {
namespace {

using Clock = std::chrono::steady_clock;

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

/// A run before its first step.
struct Prepared {
  Clock::time_point start;
  Plan plan;
  Job job;
  RunRequest request;
  OutputSet outputs;
  Output *estimates = nullptr, *summary = nullptr, *report = nullptr, *dump = nullptr;
  std::optional<CheckpointFile> checkpoint;
  std::optional<Budget> budget;
  ParticleCounts counts;  // that a run with a budget had
  OtherMachine machine;   ///< without a filter: none
};

void open_outputs(Prepared& run, const Arguments& arguments) {
  protect_inputs(run.outputs, arguments, {"--data", "--truth"});
  run.outputs.reserve(arguments.text("--checkpoint"));
  run.estimates = run.outputs.open(arguments.text("--out"));
  run.summary = run.outputs.open(arguments.text("--summary"));
  run.report = run.outputs.open(arguments.text("--report"));
  run.dump = run.outputs.open(arguments.text("--dump-particles"));
}

void prepare_dump(Prepared& run) {
  if (run.dump == nullptr) return;
  run.dump->write(particles_header(run.request.states));
  run.request.dump = [&run](Step t, const WeightedSet& set) { write_particles(*run.dump, t, set); };
}

/// Reads and checks everything; the outputs are this process's if it writes them.
void prepare(Prepared& run, const Arguments& arguments, Team* team, bool writes) {
  run.start = Clock::now();
  run.plan = plan_from(arguments);
  run.budget = budget_from(arguments, run.plan);
  run.plan.team = team;
  if (team != nullptr) check(run.plan, arguments.where());
  run.job = load_job(arguments.text("MODEL"),
                     arguments.required("--data", "a CSV file with the recording", "Pass --data obs.csv."),
                     arguments.text("--truth"), arguments.list("--set"), arguments.where());
  run.job.command = arguments.command_line();
  run.request = request_for(run.job, arguments.list("--estimate"), arguments.where());
  check_memory(run.plan, run.job, arguments.where(), run.budget ? "--most-particles" : "--particles");
  const bool has_particles = writes || !has_cast(run.plan);  // by stages they are with rank 0
  if (!has_particles) run.request.estimands.clear();
  if (has_particles && !writes && arguments.given("--dump-particles"))
    run.request.dump = [](Step, const WeightedSet&) {};  // which takes part in bringing them together
  if (!writes) return;
  open_outputs(run, arguments);
  prepare_dump(run);
  run.checkpoint = checkpoint_from(arguments, run.plan, run.job);
  if (run.checkpoint && run.checkpoint->found())
    run.job.notes.push_back(arguments.text("--checkpoint") + ": note: the run goes on from there.");
  for (const std::string& note : notes_on_unread(arguments, run.plan)) run.job.notes.push_back(note);
  for (const std::string& note : run.job.notes) fmt::print(stderr, "{}\n", printable(note));
}

/// Runs with as many particles as the time allows and the weights ask for.
RunRecord run_within(Budget& budget, Prepared& run, const std::string& where) {
  settle(budget, run.job, run.request, run.plan);
  if (budget.seconds && !budget.fits)
    fmt::print(stderr, "{}: note: --budget: {} particles are the fewest, and take longer.\n", where,
               budget.adaptive.least);
  const auto filter = adaptive_filter(budget, run.job, run.plan, where);
  RunRecord record = run_filter(*filter, run.job, run.plan, run.request);
  run.counts = filter->counts();
  return record;
}

/// A run that was told to stop ends here.
void check_whole(const Prepared& run, const RunRecord& record, const Arguments& arguments) {
  if (record.interrupted)
    throw Refusal(ExitCode::kInterrupted,
                  fmt::format("{}: interrupted after {} of {} steps; {}.", arguments.where(), record.rows.size(),
                              run.job.recording.steps.size(),
                              run.checkpoint ? "the same command goes on from " + arguments.text("--checkpoint")
                                             : "no file was written"));
}

/// Writes what was asked for.
void publish(Prepared& run, RunRecord& record) {
  record.wall_seconds = std::chrono::duration<double>(Clock::now() - run.start).count();
  Summary summary = summarise(record, run.job.truth ? &*run.job.truth : nullptr);
  if (run.budget) summary.ns_per_particle_step = 1e9 * record.step_seconds / run.counts.sum;
  if (run.estimates != nullptr) run.estimates->write(estimates_csv(record));
  if (run.summary != nullptr) {
    nlohmann::json json = summary_json(record, summary);
    if (run.budget) json["budget"] = budget_json(*run.budget, run.counts);
    json.update(run.machine.summary);
    run.summary->write(json.dump(2) + "\n");
  }
  if (run.report != nullptr) run.report->write(report_for(run.job, record, summary, run.machine.facts));
  run.outputs.commit();
  if (run.checkpoint) run.checkpoint->remove();
  if (run.outputs.on_standard_output()) return;
  print_summary(record, summary);
  if (run.budget) fmt::print("{}", budget_text(*run.budget, run.counts));
}

/// Does `work` on every rank; what stops one of them stops all: the first of these says it.
void together(Team& team, const std::function<void()>& work) {
  std::optional<Refusal> refusal;
  try {
    work();
  } catch (const Refusal& caught) {
    refusal = caught;
  }
  const auto codes = team.gather(refusal ? static_cast<std::uint32_t>(refusal->code()) : 0U);
  const auto stopped = std::find_if(codes.begin(), codes.end(), [](std::uint32_t code) { return code != 0; });
  if (stopped == codes.end()) return;
  const bool first = team.rank() == static_cast<std::size_t>(stopped - codes.begin());
  throw CommonRefusal(refusal ? *refusal : Refusal(static_cast<ExitCode>(*stopped), ""), first);
}

}  // namespace

ExitCode run_alone(const Arguments& arguments, const MachineMaker& make) {
  const std::atomic<bool>& stop = stop_flag();  // from here on, also while files are read
  Prepared run;
  prepare(run, arguments, nullptr, true);
  run.request.stop = &stop;
  if (run.checkpoint) run.request.checkpoint = &*run.checkpoint;
  if (make) run.machine = make(run.job, run.plan);
  RunRecord record;
  {
    Progress progress("steps");
    run.request.progress = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
    if (make)
      record = run_filter(*run.machine.filter, run.job, run.plan, run.request);
    else
      record = run.budget ? run_within(*run.budget, run, arguments.where())
                          : run_job(run.job, run.plan, run.request, arguments.where());
  }
  if (make) record.engine = run.machine.engine;
  check_whole(run, record, arguments);
  publish(run, record);
  return ExitCode::kDone;
}

ExitCode run_in_team(const Arguments& arguments, Team& team) {
  const bool writes = team.rank() == 0;
  Prepared run;
  together(team, [&] { prepare(run, arguments, &team, writes); });
  RunRecord record;
  try {
    std::optional<TeamCheckpoint> checkpoint;
    if (arguments.given("--checkpoint")) {  // without one a signal just ends the process
      checkpoint.emplace(team, run.checkpoint ? &*run.checkpoint : nullptr, stop_flag());
      run.request.checkpoint = &*checkpoint;
      run.request.stop = &checkpoint->stop();
    }
    // a proposal that the model does not have is refused, and a step collapses, on all ranks alike
    const auto filter = run.job.model->filter(run.plan, arguments.where());
    record = run_filter(*filter, run.job, run.plan, run.request);
    check_whole(run, record, arguments);
  } catch (const Refusal& refusal) {
    if (refusal.code() == ExitCode::kCannotWrite || refusal.code() == ExitCode::kBadData) throw;  // a checkpoint's
    throw CommonRefusal(refusal, writes);
  }
  together(team, [&] {
    if (writes) publish(run, record);
  });
  return ExitCode::kDone;
}

std::vector<OptionSpec> run_file_options() {
  return {
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
}

Command run_command(std::function<ExitCode(const Arguments&)> team) {
  std::vector<OptionSpec> options = run_file_options();
  for (OptionSpec& option : plan_options()) options.push_back(std::move(option));
  for (OptionSpec& option : budget_options()) options.push_back(std::move(option));
  for (OptionSpec& option : checkpoint_options()) options.push_back(std::move(option));
  return {"run",
          "Filter a recording",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
          std::move(options),
          [team = std::move(team)](const Arguments& arguments) {
            return arguments.text("--engine") == name_of(Engine::kMpi) ? team(arguments) : run_alone(arguments);
          },
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 4 collapsed, 5 outside tool, 6 cannot write, 130 interrupted."};
}

}  // namespace mote

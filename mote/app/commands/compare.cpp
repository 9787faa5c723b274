#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/text_entry.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/particle_list.hpp"
#include "mote/app/compare/publication.hpp"
#include "mote/app/compare/scenes.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"

namespace mote {
namespace {

using namespace compare;

constexpr SceneBounds kMost{1'000'000, 4096};
constexpr long long kMostRepeats = 10'000;

/// The reference that was asked for, its plan read before any work is done.
Reference find_reference(const Design& design, const std::string& asked, const std::optional<Plan>& plan,
                         const std::atomic<bool>& stop) {
  Progress progress("recordings of the reference");
  const auto update = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
  if (asked == "none") return {};
  if (plan) return run_reference(design, *plan, asked, update, stop);
  if (asked != "exact") return usual_reference(design, update, stop);
  Reference exact = exact_reference(design, update, stop);
  if (!exact.name.empty()) return exact;
  throw Refusal(ExitCode::kWrongUse,
                {design.where, "--reference exact", "a model and recordings with a known exact solution", design.model,
                 "Pass --reference \"" + kLargeRun + "\", or leave it out."});
}

/// Refuses a comparison without anything to measure errors by.
void check_measurable(const Design& design, const std::string& reference, std::optional<double> lost_beyond) {
  const Truth& truth = design.scenes.front().truth;
  const bool known = design.has_truth() && std::all_of(design.target.states.begin(), design.target.states.end(),
                                                       [&](std::size_t d) { return truth.known[d]; });
  if (reference == "none" && !known)
    throw Refusal(ExitCode::kWrongUse, {design.where, "--reference none", "a truth of " + design.target.name, "none",
                                        "Pass --truth, or leave --reference out."});
  if (lost_beyond && !known)
    throw Refusal(ExitCode::kWrongUse, {design.where, "--lost-beyond", "a truth of " + design.target.name, "none",
                                        "Pass --truth, or leave it out."});
}

std::optional<double> lost_beyond_from(const Arguments& arguments) {
  if (!arguments.given("--lost-beyond")) return std::nullopt;
  return arguments.number("--lost-beyond", 0, 1e300);
}

void protect_inputs(OutputSet& outputs, const Arguments& arguments) {
  outputs.protect(arguments.text("--data"));
  outputs.protect(arguments.text("--truth"));
  for (const std::string_view model : parts_of(arguments.text("MODEL"), ','))
    if (is_text_model(std::string(model))) outputs.protect(std::string(model));
  for (const std::string& setting : arguments.list("--set"))
    if (setting.starts_with("file=")) outputs.protect(setting.substr(5));
}

/// A comparison on one model, checked, ready to run; and the reference that was asked for as a plan.
struct Prepared {
  Outcome outcome;
  std::optional<Plan> reference_run;
};

Prepared prepare(const Arguments& arguments, const std::string& model, std::vector<std::string>& notes) {
  Prepared prepared;
  Outcome& outcome = prepared.outcome;
  outcome.command = arguments.command_line();
  outcome.lost_beyond = lost_beyond_from(arguments);
  Design& design = outcome.design;
  design.model = model;
  design.where = arguments.where();
  design.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  design.repeats = static_cast<std::size_t>(arguments.integer("--repeats", 1, kMostRepeats));
  design.particles = particle_list_from(arguments);
  design.contenders = contenders_from(
      arguments.required("--filters", "filters with their options, separated by ;", "Pass --filters \"sisr; imh\"."),
      design.particles, design.where, notes);
  const std::string reference = arguments.text("--reference");
  if (reference != "auto" && reference != "exact" && reference != "none")
    prepared.reference_run = reference_plan(reference, design.where, notes);
  outcome.source = find_scenes(arguments, kMost, design, notes);
  design.target = target_of(arguments.text("--state"), design.catalogue_model->states(), design.where);
  check_measurable(design, reference, outcome.lost_beyond);
  check_contenders(design);
  return prepared;
}

void compare_filters(const Arguments& arguments, Prepared& prepared, const std::atomic<bool>& stop) {
  Outcome& outcome = prepared.outcome;
  Design& design = outcome.design;
  design.reference = find_reference(design, arguments.text("--reference"), prepared.reference_run, stop);
  Progress progress("particles");
  outcome.runs = run_study(
      design, [&](std::size_t done, std::size_t all) { progress.update(done, all); }, stop);
  outcome.figures = figures_of(design, outcome.runs, outcome.lost_beyond);
}

ExitCode run_compare(const Arguments& arguments) {
  std::vector<std::string> notes;
  std::vector<Prepared> all;
  const std::string models = arguments.text("MODEL");
  for (const std::string_view model : parts_of(models, ',')) {
    notes.clear();  // each model's contenders give the same ones
    all.push_back(prepare(arguments, std::string(model), notes));
  }
  OutputSet outputs;
  protect_inputs(outputs, arguments);
  Output* csv = outputs.open(arguments.text("--out"));
  Output* json = outputs.open(arguments.text("--json"));
  Output* page = outputs.open(arguments.text("--report"));
  for (const std::string& note : notes) fmt::print(stderr, "{}\n", printable(note));
  std::vector<Outcome> outcomes;
  for (Prepared& prepared : all) {
    compare_filters(arguments, prepared, stop_flag());
    outcomes.push_back(std::move(prepared.outcome));
  }
  if (csv != nullptr) csv->write(comparison_csv(outcomes));
  if (json != nullptr) json->write(comparison_json(outcomes).dump(2) + "\n");
  if (page != nullptr) page->write(report::html(comparison_page(outcomes)));
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", comparison_table(outcomes));
  return ExitCode::kDone;
}

}  // namespace

Command compare_command() {
  return {
      "compare",
      "Compare filters on the same recordings",
      {{"MODEL", "a model of the catalogue (see mote models), or a .toml file, or several separated by commas"}},
      {{"--data", "FILE", "", "one recording as CSV, instead of simulated ones", "Data"},
       {"--truth", "FILE", "", "its true states as CSV [none]", "Data"},
       {"--steps", "T", "100", "steps of a simulated recording, from 1 to 1000000", "Data"},
       {"--recordings", "K", "10", "simulated recordings, from 1 to 10000", "Data"},
       {"--columns", "M", "1", "doa: directions per frame, from 1 to 4096", "Data"},
       {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Data", true},
       {"--filters", "LIST", "",
        "contenders, separated by ; : a filter's name, then options of mote run; must be given", "Contenders"},
       {"-n,--particles", "LIST", "1000", "numbers of particles, separated by commas", "Contenders"},
       {"--repeats", "R", "20", "runs of every contender on every recording, from 1 to 10000", "Contenders"},
       {"--seed", "S", "1", "first seed; repeat r on recording k has S + k R + r, recording k has S + k", "Contenders"},
       {"--reference", "WHAT", "auto",
        "what means are compared with: auto = exact where known, else \"" + kLargeRun +
            "\"; exact; none; or a filter with options",
        "Judgement"},
       {"--state", "NAME", "", "whose error [position for models with x and y, else the first state]", "Judgement"},
       {"--lost-beyond", "D", "", "count tracks that end further from the truth than D [not counted]", "Judgement"},
       {"--out", "FILE", "", "the table as CSV; - is standard output [none]", "Output"},
       {"--json", "FILE", "", "design, table and every run as JSON [none]", "Output"},
       {"--report", "FILE", "", "report with a plot, one HTML file [none]", "Output"}},
      run_compare,
      "Exit codes: 0 done, 2 wrong use, 3 bad data, 4 the reference collapsed, 6 cannot write, 130 interrupted."};
}

}  // namespace mote

#include "mote/app/compare/scenes.hpp"

#include <fmt/format.h>

#include "mote/app/compare/contender.hpp"
#include "mote/base/refusal.hpp"

namespace mote::compare {
namespace {

constexpr long long kMostRecordings = 10'000;

std::string simulate_scenes(const Arguments& arguments, const SceneBounds& bounds, Design& design) {
  const auto header = frame_header(arguments.integer("--columns", 1, bounds.columns));
  const auto steps = static_cast<Step>(arguments.integer("--steps", 1, bounds.steps));
  const auto recordings = static_cast<std::size_t>(arguments.integer("--recordings", 1, kMostRecordings));
  design.catalogue_model =
      find_model(design.model, design.where).make(Settings(design.where, arguments.list("--set")), header);
  for (std::size_t k = 0; k < recordings; ++k)
    design.scenes.push_back(simulated_scene(*design.catalogue_model, steps, design.seed + k));
  return fmt::format("{} recording{} of {} steps (seeds {} to {})", recordings, recordings == 1 ? "" : "s", steps,
                     design.seed, design.seed + recordings - 1);
}

std::string load_scene(const Arguments& arguments, Design& design, std::vector<std::string>& notes) {
  for (const std::string name : {"--steps", "--recordings", "--columns"})
    if (arguments.given(name))
      throw Refusal(ExitCode::kWrongUse, {design.where, name, "simulated recordings", "--data with one of its own",
                                          "Leave out " + name + " or --data."});
  Job job = load_job(design.model, arguments.text("--data"), arguments.text("--truth"), arguments.list("--set"),
                     design.where);
  design.catalogue_model = job.model;
  design.scenes.push_back({std::move(job.recording), job.truth ? std::move(*job.truth) : Truth{}});
  notes.insert(notes.end(), job.notes.begin(), job.notes.end());
  return arguments.text("--data");
}

}  // namespace

std::string find_scenes(const Arguments& arguments, const SceneBounds& bounds, Design& design,
                        std::vector<std::string>& notes) {
  if (arguments.given("--data")) return load_scene(arguments, design, notes);
  if (arguments.given("--truth"))
    throw Refusal(ExitCode::kWrongUse, {design.where, "--truth", "--data, whose truth it is", "nothing",
                                        "Pass --data, or leave --truth out: simulated recordings have their own."});
  return simulate_scenes(arguments, bounds, design);
}

Reference usual_reference(const Design& design, const ProgressOf& progress, const std::atomic<bool>& stop) {
  Reference exact = exact_reference(design, progress, stop);
  if (!exact.name.empty()) return exact;
  std::vector<std::string> no_notes;
  return run_reference(design, reference_plan(kLargeRun, design.where, no_notes), kLargeRun, progress, stop);
}

}  // namespace mote::compare

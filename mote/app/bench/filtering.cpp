// The tasks that filter a recording.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/bench/racers.hpp"
#include "mote/app/bench/task_list.hpp"

namespace mote::bench {
namespace {

constexpr Step kSteps = 100;
constexpr Step kTrackingSteps =
    30;  // the target's range is soon lost from a sensor at rest, and then few particles live
constexpr std::uint64_t kRecording = 1;  // seed
constexpr std::size_t kJudged = 1000;    // particles of a judged run
constexpr std::uint64_t kRuns = 20;
constexpr std::uint64_t kManyRuns = 100;  // where a run varies much
constexpr std::size_t kShared = 100'000;  // particles of a judged run on several threads

// claim    the means are those of a bootstrap filter of 1000 particles
// referee  the exact posterior mean on a grid
// design   20 runs, seeds 1 to 20, on one recording: the mean RMSE of the reference engine over 1000 runs is kExpected,
//          the standard deviation of one run kDeviation (`mote compare ungm --filters "sisr --engine reference"
//          --recordings 1 --repeats 1000`)
// risk     the band is 6 standard errors wide on either side; the twin with omega = 1.21 must be caught
Verdict near_the_grid(const Entrant& entrant, const std::vector<double>& exact) {
  constexpr double kExpected = 0.48;
  constexpr double kDeviation = 0.1;
  const double band = 6 * kDeviation / std::sqrt(static_cast<double>(kRuns));
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) sum += rms_between(answer_of(entrant, kJudged, seed), exact);
  return {fmt::format("RMSE to the exact mean over {} runs of {} particles", kRuns, kJudged), sum / kRuns,
          kExpected - band, kExpected + band};
}

std::vector<double> first_components(const std::vector<std::vector<double>>& means) {
  std::vector<double> all;
  for (const auto& mean : means) all.push_back(mean[0]);
  return all;
}

Task growth(const TaskEntry& entry, Precision precision, const contenders::Description& limit) {
  const auto course = simulated_course("ungm", kSteps, kRecording);
  Task task{entry.name, entry.meaning, Clock::kThread, course->steps(), {}, {}};
  Plan means = plan_of(Engine::kSimd, precision);  // all that the others form, too
  means.estimates = Estimates::kMeans;
  task.entrants = {filter_entrant("simd", course, means),
                   filter_entrant("simd+sd", course, plan_of(Engine::kSimd, precision)),
                   contender_entrant(contenders::kBaseline, course),
                   contender_entrant(limit, course),
                   filter_entrant("reference", course, plan_of(Engine::kReference, precision)),
                   contender_entrant(contenders::kNumpy, course)};
  const auto exact = first_components(course->model->solver()->solve(course->scene.recording).value().means);
  task.judge = [exact](const Entrant& entrant) { return near_the_grid(entrant, exact); };
  return task;
}

// claim    the means are those of the reference engine in double, which draws the same numbers
// referee  the reference engine
// design   1000 particles, seed 1, 10 steps. Vectors round otherwise, by parts in 1e-16, and their normal numbers
//          are good to 1e-8; a child gets another parent when a cumulative weight comes that near to a target,
//          not in these steps
// risk     none: the verdict is fixed; another seed differs by 0.01
Verdict like_the_reference(const Entrant& entrant, const Entrant& reference, std::size_t components) {
  constexpr std::size_t kCompared = 10;
  auto own = answer_of(entrant, kJudged, 1);
  auto expected = answer_of(reference, kJudged, 1);
  own.resize(kCompared * components);
  expected.resize(kCompared * components);
  return {fmt::format("greatest difference of a mean to the reference engine's, {} particles, {} steps", kJudged,
                      kCompared),
          greatest_between(own, expected), 0, 1e-6};
}

/// Component 0 of an answer in its first 20 steps.
std::vector<double> first_component(const std::vector<double>& answer, std::size_t components) {
  std::vector<double> first;
  for (std::size_t i = 0; i < 20 * components; i += components) first.push_back(answer[i]);
  return first;
}

/// Mean over 100 runs of 1000 particles of the RMSE of component 0 to `expected`.
double mean_rmse(const Entrant& entrant, const std::vector<double>& expected, std::size_t components) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kManyRuns; ++seed)
    sum += rms_between(first_component(answer_of(entrant, kJudged, seed), components), expected);
  return sum / kManyRuns;
}

// claim    in float, a filter errs as much as the reference engine in double. (Float's cumulative weights put a
//          child in a thousand to a neighbour, after which two runs are as good as independent.)
// referee  a run of the reference engine with 200 000 particles
// design   100 runs of 1000 particles, 20 steps: the RMSE of a run of `bearings` varies by 56 %, the ratio of two
//          means of 100 by 8 %
// risk     the band is 5 standard errors wide on either side
Verdict errs_like(const Entrant& entrant, double usual, const std::vector<double>& expected, std::size_t components) {
  return {fmt::format("RMSE to a large run, over that of the reference engine; {} runs of {} particles", kManyRuns,
                      kJudged),
          mean_rmse(entrant, expected, components) / usual, 0.6, 1.5};
}

Task tracking(const TaskEntry& entry, const std::string& model) {
  const auto course = simulated_course(model, kTrackingSteps, kRecording);
  const std::size_t components = course->model->states().size();
  Task task{entry.name, entry.meaning, Clock::kThread, course->steps(), {}, {}};
  for (const Engine engine : {Engine::kSimd, Engine::kReference})
    for (const Precision precision : {Precision::kFloat, Precision::kDouble})
      task.entrants.push_back(
          filter_entrant(fmt::format("{}-{}", name_of(engine), precision == Precision::kFloat ? "float" : "double"),
                         course, plan_of(engine, precision)));
  const Entrant reference = task.entrants.back();
  const auto expected = first_component(answer_of(reference, 200'000, kManyRuns + 1), components);
  const double usual = mean_rmse(reference, expected, components);
  task.judge = [=](const Entrant& entrant) {
    return entrant.name.ends_with("double") ? like_the_reference(entrant, reference, components)
                                            : errs_like(entrant, usual, expected, components);
  };
  return task;
}

/// A filter of the growth model that needs no random parents, or no resampling, and what the reference engine makes of
/// it.
struct Kind {
  std::string name;
  FilterKind filter;
  std::size_t chains;
};
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"sisr", FilterKind::kSisr, 1}, {"imh-16", FilterKind::kImh, 16}, {"sqmc", FilterKind::kSqmc, 1}};
  return all;
}
Plan plan_of_kind(const Kind& kind, Engine engine, Precision precision) {
  Plan plan = plan_of(engine, precision);
  plan.filter = kind.filter;
  plan.chain.chains = kind.chains;
  return plan;
}

}  // namespace

// claim    a filter of the SIMD engine in float errs as the reference engine's in double
// referee  the exact posterior mean on a grid
// design   100 runs of 1000 particles on one recording: the ratio of the two mean RMSE
// risk     the band is 6 standard errors wide on either side (a run varies by a fifth, `sqmc` by two fifths)
Task filters_task(const TaskEntry& entry, std::size_t) {
  const auto course = simulated_course("ungm", kSteps, kRecording);
  Task task{entry.name, entry.meaning, Clock::kThread, course->steps(), {}, {}};
  for (const Kind& kind : kinds()) {
    Plan plan = plan_of_kind(kind, Engine::kSimd, Precision::kFloat);
    plan.estimates = Estimates::kMeans;
    task.entrants.push_back(filter_entrant(kind.name, course, plan));
  }
  const auto exact = first_components(course->model->solver()->solve(course->scene.recording).value().means);
  task.judge = [=](const Entrant& entrant) {
    const Kind& kind =
        *std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) { return k.name == entrant.name; });
    const Entrant usual = filter_entrant("", course, plan_of_kind(kind, Engine::kReference, Precision::kDouble));
    const auto rmse = [&](const Entrant& who) {
      double sum = 0;
      for (std::uint64_t seed = 1; seed <= kManyRuns; ++seed) sum += rms_between(answer_of(who, kJudged, seed), exact);
      return sum / kManyRuns;
    };
    const double own = rmse(entrant);
    return Verdict{
        fmt::format("RMSE to the exact mean, {:.3g}, over that of the reference engine; {} runs of {} particles", own,
                    kManyRuns, kJudged),
        own / rmse(usual), 0.7, 1.4};
  };
  return task;
}

Task growth_float_task(const TaskEntry& entry, std::size_t) {
  return growth(entry, Precision::kFloat, contenders::kLimitFloat);
}
Task growth_double_task(const TaskEntry& entry, std::size_t) {
  return growth(entry, Precision::kDouble, contenders::kLimitDouble);
}
Task bearings_task(const TaskEntry& entry, std::size_t) { return tracking(entry, "bearings"); }
Task doa_task(const TaskEntry& entry, std::size_t) { return tracking(entry, "doa"); }

// claim    results do not depend on the number of threads
// referee  one thread
// design   100 000 particles, so that every thread has blocks of its own; equal bit by bit
Task threads_task(const TaskEntry& entry, std::size_t threads) {
  const auto course = simulated_course("ungm", kSteps, kRecording);
  Task task{entry.name, entry.meaning, Clock::kWall, course->steps(), {}, {}};
  for (std::size_t count = 1; count <= threads; count = count < threads ? std::min(2 * count, threads) : count + 1)
    task.entrants.push_back(
        filter_entrant(fmt::format("simd x {}", count), course, plan_of(Engine::kSimd, Precision::kFloat, count)));
  task.judge = [alone = task.entrants.front()](const Entrant& entrant) {
    return Verdict{fmt::format("greatest difference of a mean to one thread's, {} particles", kShared),
                   greatest_between(answer_of(entrant, kShared, 1), answer_of(alone, kShared, 1)), 0, 0};
  };
  return task;
}

}  // namespace mote::bench

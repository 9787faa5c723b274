// The task that holds the pipeline against its latency law.

#include <algorithm>

#include <fmt/format.h>

#include "mote/app/bench/racers.hpp"
#include "mote/app/bench/task_list.hpp"
#include "mote/engine/latency.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/pipeline/pipelined.hpp"

namespace mote::bench {
namespace {

constexpr Step kStatedSteps = 1;
constexpr Step kComputedSteps = 20;   // the first finds sleeping threads and cold memory
constexpr std::size_t kJudged = 100;  // particles of a judged run
constexpr std::size_t kMost = 2000;   // particles whose cost is stated: a second or so a run

constexpr std::size_t kMostComputed = 20'000;  // at some 10 us each

/// What a particle takes in each stage where that is stated, s: a slow likelihood, half of IMH-OPT's 1.1 ms.
constexpr StageTimes kStated{0.000150, 0.000600, 0.000040};

/// How the pipeline is manned, and whether its stages wait for a stated time or compute alone.
struct Setting {
  std::size_t proposers, weighers;
  bool computes = false;
  std::size_t threads = proposers + weighers + (computes ? 0 : 1);

  Step steps() const { return computes ? kComputedSteps : kStatedSteps; }
  std::string name() const {
    return fmt::format("{} x {}{}", proposers, weighers,
                       computes ? fmt::format(", {} thread{}", threads, threads == 1 ? "" : "s") : "");
  }
};

/// One chain, by a pipeline that times its stages itself: IMH on the growth model where costs are stated, else what
/// proposes and weighs at about the same length, the auxiliary filter on bearings by guided proposals.
class PipelineRacer final : public Racer {
 public:
  PipelineRacer(std::shared_ptr<const Course> course, const Setting& setting)
      : course_(std::move(course)), setting_(setting) {}

  void prepare(std::size_t particles, std::uint64_t seed) override {
    PipelineSize size{setting_.proposers, setting_.weighers, 1, setting_.threads, 0, {}};
    if (!setting_.computes) size.pace = {kStated.propose, kStated.weigh, kStated.chain};
    filter_.reset();
    filter_ = std::make_unique<PipelinedFilter>(size, [&](StageRunner& runner) -> std::unique_ptr<Filter> {
      if (setting_.computes)
        return make_auxiliary<double, Guided>(Bearings{}, particles, seed, {}, OnCollapse::kStop, runner);
      return make_imh(Ungm<1>{}, particles, seed, {}, OnCollapse::kStop, runner);
    });
  }
  void run(std::vector<double>& answer) override {
    answer.clear();
    Step t = 0;
    for (const ObservedStep& step : course_->scene.recording.steps) {
      StepReport report = filter_->update(++t, step.rows);
      for (std::size_t d = 0; d < course_->model->states().size(); ++d)
        answer.push_back(filter_->moments(d, false).mean);
      filter_->select(t, report);
    }
  }
  double outside_seconds() const override { return filter_ ? filter_->stages().seconds : kNaN; }
  std::optional<StageRecord> stages() const override { return filter_->stages(); }

 private:
  std::shared_ptr<const Course> course_;
  Setting setting_;
  std::unique_ptr<PipelinedFilter> filter_;
};

/// What a particle takes in each stage where one thread computes them.
StageTimes computed(const std::shared_ptr<const Course>& course, std::size_t particles) {
  PipelineRacer racer(course, {1, 1, true, 1});
  std::vector<double> answer;
  racer.prepare(particles, 1);
  racer.run(answer);
  const StageRecord record = racer.stages().value();
  const auto busy = [&](std::size_t stage) {
    return record.stages[stage].workers[0].busy_seconds / (kComputedSteps * static_cast<double>(particles));
  };
  return {busy(0), busy(1), busy(2)};
}

/// Seconds of a run by the law of a single chain, for blocks of particles.
double predicted(const Setting& setting, const StageTimes& particle, std::size_t particles) {
  const auto n = static_cast<double>(particles);
  const auto length = static_cast<double>(block_for(particles, std::max(setting.proposers, setting.weighers)));
  const double block = std::min(n, length);
  const StageTimes times{particle.propose * block, particle.weigh * block, particle.chain * block};
  return setting.steps() * single_chain_time(n / block, times, static_cast<double>(setting.proposers),
                                             static_cast<double>(setting.weighers));
}

Entrant setting_entrant(const std::shared_ptr<const Course>& course, const Setting& setting) {
  const std::string meaning =
      fmt::format("{} proposers, {} weighers, one chain, {} threads; stages {}", setting.proposers, setting.weighers,
                  setting.threads, setting.computes ? "compute" : "wait as long as stated");
  Entrant entrant{setting.name(), meaning, kNaN, "", [=] { return std::make_unique<PipelineRacer>(course, setting); }};
  if (!setting.computes)
    entrant.predicted = [=](std::size_t particles) { return predicted(setting, kStated, particles); };
  else if (setting.threads > 1)
    entrant.predicted = [=](std::size_t n) { return predicted(setting, computed(course, n), n); };
  return entrant;
}

/// A task of settings, each judged by the reference engine.
Task settings_task(const TaskEntry& entry, const std::vector<Setting>& settings) {
  const bool computes = settings.front().computes;
  const auto course = simulated_course(computes ? "bearings" : "ungm", settings.front().steps(), 1);
  Task task{entry.name, entry.meaning, Clock::kWall, course->steps(), {}, {}};
  for (const Setting& setting : settings) task.entrants.push_back(setting_entrant(course, setting));
  Plan plan = plan_of(Engine::kReference, Precision::kDouble);
  plan.filter = computes ? FilterKind::kAuxiliary : FilterKind::kImh;
  if (computes) plan.proposal = Guided::kName;
  task.judge = [reference = filter_entrant("reference", course, plan)](const Entrant& entrant) {
    return Verdict{fmt::format("greatest difference of a mean to the reference engine's, {} particles", kJudged),
                   greatest_between(answer_of(entrant, kJudged, 1), answer_of(reference, kJudged, 1)), 0, 0};
  };
  return task;
}

}  // namespace

// claim    the pipeline's results are the reference engine's
// referee  the reference engine
// design   100 particles, seed 1; equal bit by bit
Task pipeline_task(const TaskEntry& entry, std::size_t) {
  Task task = settings_task(entry, {{1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 6}, {2, 4}, {2, 6}, {2, 8}, {4, 16}});
  task.most_particles = kMost;
  return task;
}
Task computing_pipeline_task(const TaskEntry& entry, std::size_t) {
  Task task = settings_task(entry, {{1, 1, true}, {1, 1, true, 1}});
  task.most_particles = kMostComputed;
  return task;
}

}  // namespace mote::bench

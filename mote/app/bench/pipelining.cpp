// The task that holds the pipeline against its latency law.

#include <algorithm>

#include <fmt/format.h>

#include "mote/app/bench/racers.hpp"
#include "mote/app/bench/task_list.hpp"
#include "mote/engine/latency.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/pipeline/pipelined.hpp"

namespace mote::bench {
namespace {

constexpr Step kSteps = 1;
constexpr std::size_t kJudged = 1000;  // particles of a judged run

/// What the stages of a step take in all if one worker does each, s: the wait of a block is its particles' share.
constexpr StageTimes kStated{0.060, 0.240, 0.015};

/// How the pipeline is manned, and whether its stages wait for a stated time or compute alone.
struct Setting {
  std::size_t proposers, weighers;
  bool computes;

  std::string name() const { return fmt::format("{} x {}{}", proposers, weighers, computes ? ", computing" : ""); }
};

/// IMH on the growth model by one chain; times its stages itself.
class PipelineRacer final : public Racer {
 public:
  PipelineRacer(std::shared_ptr<const Course> course, Setting setting, std::size_t threads)
      : course_(std::move(course)), setting_(setting), threads_(threads) {}

  void prepare(std::size_t particles, std::uint64_t seed) override {
    Plan plan = plan_of(Engine::kPipeline, Precision::kDouble);
    plan.filter = FilterKind::kImh;
    plan.particles = particles;
    plan.seed = seed;
    PipelineSize size{setting_.proposers, setting_.weighers, 1, threads_, 0, {}};
    const auto n = static_cast<double>(particles);
    if (!setting_.computes) size.pace = {kStated.propose / n, kStated.weigh / n, kStated.chain / n};
    filter_.reset();
    filter_ = make_pipeline_filter(Ungm<1>{}, plan, "mote bench", size);
  }
  void run(std::vector<double>& answer) override {
    answer.clear();
    Step t = 0;
    for (const ObservedStep& step : course_->scene.recording.steps) {
      StepReport report = filter_->update(++t, step.rows);
      answer.push_back(filter_->moments(0, false).mean);
      filter_->select(t, report);
    }
  }
  double outside_seconds() const override { return filter_ ? stages().seconds : kNaN; }
  StageRecord stages() const { return dynamic_cast<const Staged&>(*filter_).stages(); }

 private:
  std::shared_ptr<const Course> course_;
  Setting setting_;
  std::size_t threads_;
  std::unique_ptr<Filter> filter_;
};

/// What the stages of a step take in all if one thread computes them.
StageTimes computed(const std::shared_ptr<const Course>& course, std::size_t particles) {
  PipelineRacer racer(course, {1, 1, true}, 1);
  std::vector<double> answer;
  racer.prepare(particles, 1);
  racer.run(answer);
  const StageRecord record = racer.stages();
  const auto busy = [&](std::size_t stage) { return record.stages[stage].workers[0].busy_seconds / kSteps; };
  return {busy(0), busy(1), busy(2)};
}

/// Seconds of a run by the law of a single chain, for blocks of particles.
double predicted(const Setting& setting, const StageTimes& all, std::size_t particles) {
  const std::size_t block = block_for(particles, std::max(setting.proposers, setting.weighers));
  const double blocks = std::max(1.0, static_cast<double>(particles) / static_cast<double>(block));
  const StageTimes times{all.propose / blocks, all.weigh / blocks, all.chain / blocks};
  return kSteps * single_chain_time(blocks, times, static_cast<double>(setting.proposers),
                                    static_cast<double>(setting.weighers));
}

Entrant setting_entrant(const std::shared_ptr<const Course>& course, const Setting& setting) {
  const std::size_t threads = setting.computes ? 2 : setting.proposers + setting.weighers + 1;
  const std::string meaning =
      fmt::format("{} proposers, {} weighers, one chain, {} threads; stages {}", setting.proposers, setting.weighers,
                  threads, setting.computes ? "compute" : "wait as long as stated");
  return {setting.name(),
          meaning,
          kNaN,
          "",
          [=] { return std::make_unique<PipelineRacer>(course, setting, threads); },
          [=](std::size_t particles) {
            return predicted(setting, setting.computes ? computed(course, particles) : kStated, particles);
          }};
}

}  // namespace

// claim    the pipeline's results are the reference engine's
// referee  the reference engine
// design   1000 particles, seed 1; equal bit by bit
Task pipeline_task(const TaskEntry& entry, std::size_t) {
  const auto course = simulated_course("ungm", kSteps, 1);
  Task task{entry.name, entry.meaning, Clock::kWall, course->steps(), {}, {}, true};
  for (const auto& [proposers, weighers] : std::vector<std::pair<std::size_t, std::size_t>>{
           {1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 6}, {2, 4}, {2, 6}, {2, 8}, {4, 16}})
    task.entrants.push_back(setting_entrant(course, {proposers, weighers, false}));
  task.entrants.push_back(setting_entrant(course, {1, 1, true}));
  Plan plan = plan_of(Engine::kReference, Precision::kDouble);
  plan.filter = FilterKind::kImh;
  task.judge = [reference = filter_entrant("reference", course, plan)](const Entrant& entrant) {
    return Verdict{fmt::format("greatest difference of a mean to the reference engine's, {} particles", kJudged),
                   greatest_between(answer_of(entrant, kJudged, 1), answer_of(reference, kJudged, 1)), 0, 0};
  };
  return task;
}

}  // namespace mote::bench

#include "mote/app/simulated/measurement.hpp"

#include <algorithm>
#include <ctime>

#include "mote/app/catalogue/scene.hpp"
#include "mote/engine/run.hpp"

namespace mote::simulated {
namespace {

constexpr std::size_t kMostMeasured = 1'000'000;

/// Times of stages by their shares of the processor's time, which other programs do not lengthen.
StageTimes times_of(const RunRecord& record, const Plan& plan, double seconds) {
  const double a_particle = seconds / static_cast<double>(plan.particles) / static_cast<double>(record.predicted_steps);
  if (!record.stages) return {a_particle, 0, 0};
  const auto busy = [&](std::size_t stage) {
    double sum = 0;
    if (stage < record.stages->stages.size())
      for (const StageWorker& worker : record.stages->stages[stage].workers) sum += worker.busy_seconds;
    return sum;
  };
  const double last = plan.filter == FilterKind::kSisr ? record.stages->barrier_seconds : busy(2);
  const double unit = a_particle / record.step_seconds;
  return {busy(0) * unit, busy(1) * unit, last * unit};
}

Plan plan_of(const Workload& work, const std::string& proposal) {
  Plan plan;
  plan.filter = work.filter == FilterKind::kDistributed ? FilterKind::kSisr : work.filter;
  plan.particles = std::min(work.particles, kMostMeasured);
  plan.chain.chains = std::min(work.chains, plan.particles);
  if (work.weighted_start) plan.chain.start = ChainStart::kWeighted;
  plan.precision = work.number_bytes == 4 ? Precision::kFloat : Precision::kDouble;
  plan.proposal = proposal;
  plan.seed = work.seed;
  if (work.by_stages) plan.engine = Engine::kPipeline;
  return plan;
}

}  // namespace

Measurement measured(const CatalogueModel& model, const Workload& work, const std::string& proposal,
                     const std::string& where) {
  constexpr std::size_t kEnough = 500'000;  // particles moved, for a clock that ticks in microseconds
  constexpr int kRuns = 5;
  const Plan plan = plan_of(work, proposal);
  const auto steps = static_cast<Step>(std::clamp<std::size_t>(kEnough / plan.particles, 5, 1000));
  check(plan, where);
  const Recording recording = simulated_scene(model, steps, work.seed).recording;
  RunRequest request;
  request.where = where;
  request.states = model.states();
  Measurement quickest;
  double least = kInfinity;
  for (int k = 0; k < kRuns; ++k) {
    const auto filter = model.filter(plan, where);
    const std::clock_t start = std::clock();
    const RunRecord record = run(*filter, plan, recording, request);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (seconds >= least) continue;
    least = seconds;
    quickest = {times_of(record, plan, seconds),
                summarise(record, nullptr).mean_ess / static_cast<double>(plan.particles)};
  }
  return quickest;
}

}  // namespace mote::simulated

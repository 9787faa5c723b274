#include "mote/engine/run.hpp"

#include <chrono>

#include <fmt/format.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

EstimateRow estimated(Step t, const StepReport& report, const Filter& filter, const RunRequest& request,
                      std::vector<double>& scratch) {
  EstimateRow row{t, {}, {}, report};
  for (std::size_t d = 0; d < request.states.size(); ++d)
    row.states.push_back(filter.moments(d, request.states[d].angle));
  for (const Estimand& estimand : request.estimands)
    row.functions.push_back(evaluate(estimand, request.sources[estimand.source], filter.weighted(), scratch));
  return row;
}

std::string what_collapsed(const Plan& plan) {
  if (is_gaussian(plan.filter))
    return "its law gives this step's observation the density zero. Pass a wider model, or --on-collapse keep or "
           "reset.";
  return fmt::format(
      "every one of {} particles has weight zero for this step's observation. Pass more --particles, a wider model, or "
      "--on-collapse keep or reset.",
      plan.particles);
}

}  // namespace

RunRecord run(Filter& filter, const Plan& plan, const Recording& recording, const RunRequest& request) {
  RunRecord record;
  record.plan = plan;
  record.states = request.states;
  for (const Estimand& estimand : request.estimands) record.function_labels.push_back(estimand.label);
  std::vector<double> scratch;
  Step t = 0;
  const auto stopped = [&] { return request.stop != nullptr && request.stop->load(); };
  for (std::size_t k = 0; k < recording.steps.size() && !stopped(); ++k) {
    const ObservedStep& step = recording.steps[k];
    Stopwatch watch;
    while (t + 1 < step.t && !stopped()) filter.predict(++t);
    if (stopped()) break;
    ++t;
    const bool observed = !step.rows.empty();
    StepReport report = observed ? filter.update(t, step.rows) : filter.predict(t);
    if (report.collapsed && plan.on_collapse == OnCollapse::kStop)
      throw Refusal(ExitCode::kCollapsed,
                    fmt::format("{}: t = {}: the filter collapsed: {}", request.where, t, what_collapsed(plan)));
    record.rows.push_back(estimated(t, report, filter, request, scratch));
    record.step_seconds += watch.seconds();
    if (request.dump) request.dump(t, filter.weighted());
    Stopwatch selection;
    if (observed) filter.select(t, record.rows.back().report);
    record.step_seconds += selection.seconds();
    request.progress(k + 1, recording.steps.size());
  }
  record.interrupted = record.rows.size() < recording.steps.size();
  record.predicted_steps = static_cast<std::size_t>(t);
  return record;
}

}  // namespace mote

#include "mote/engine/run.hpp"

#include <chrono>

#include <fmt/format.h>

#include "mote/base/refusal.hpp"
#include "mote/filter/adaptive.hpp"

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
  if (request.estimands.empty()) return row;
  const WeightedSet set = filter.weighted();
  for (const Estimand& estimand : request.estimands)
    row.functions.push_back(evaluate(estimand, request.sources[estimand.source], set, scratch));
  return row;
}

/// What weighed nothing: those of the step, where their number changes.
std::string what_collapsed(const Filter& filter, const Plan& plan) {
  if (is_gaussian(plan.filter))
    return "its law gives this step's observation the density zero. Pass a wider model, or --on-collapse keep or "
           "reset.";
  const auto* adaptive = dynamic_cast<const AdaptiveFilter*>(&filter);
  return fmt::format(
      "every one of {} particles has weight zero for this step's observation. Pass {}, a wider model, or --on-collapse "
      "keep or reset.",
      adaptive == nullptr ? plan.particles : adaptive->weighed(),
      adaptive == nullptr ? "more --particles" : "a larger --budget or --most-particles");
}

/// A filter on its way along a recording.
class Journey {
 public:
  Journey(Filter& filter, const Plan& plan, const RunRequest& request)
      : filter_(filter), request_(request), on_collapse_(plan.on_collapse) {
    state_.record.plan = plan;
    state_.record.states = request.states;
    for (const Estimand& estimand : request.estimands) state_.record.function_labels.push_back(estimand.label);
    if (request_.checkpoint != nullptr) request_.checkpoint->resume(keeper());
  }

  RunRecord along(const Recording& recording) {
    RunRecord& record = state_.record;
    while (record.rows.size() < recording.steps.size() && !stopped()) {
      const ObservedStep& step = recording.steps[record.rows.size()];
      if (!cross_gap_before(step.t)) break;
      visit(step);
      request_.progress(record.rows.size(), recording.steps.size());
      step_done();
    }
    record.interrupted = record.rows.size() < recording.steps.size();
    record.predicted_steps = static_cast<std::size_t>(state_.t);
    if (const auto* staged = dynamic_cast<const Staged*>(&filter_)) record.stages = staged->stages();
    if (record.interrupted && request_.checkpoint != nullptr) request_.checkpoint->stopped(keeper());
    return std::move(record);
  }

 private:
  bool stopped() const { return request_.stop != nullptr && request_.stop->load(); }

  KeepRun keeper() {
    return [this](Archive& archive) { archive(state_, filter_); };
  }
  void step_done() {
    if (request_.checkpoint != nullptr) request_.checkpoint->step_done(keeper());
  }

  /// Predicts up to the step before t; false if told to stop on the way.
  bool cross_gap_before(Step t) {
    while (state_.t + 1 < t && !stopped()) {
      const Stopwatch watch;
      filter_.predict(++state_.t);
      state_.record.step_seconds += watch.seconds();
      step_done();
    }
    return !stopped();
  }

  void visit(const ObservedStep& step) {
    const Stopwatch watch;
    const Step t = ++state_.t;
    const bool observed = !step.rows.empty();
    const StepReport report = observed ? filter_.update(t, step.rows) : filter_.predict(t);
    if (report.collapsed && on_collapse_ == OnCollapse::kStop)
      throw Refusal(ExitCode::kCollapsed, fmt::format("{}: t = {}: the filter collapsed: {}", request_.where, t,
                                                      what_collapsed(filter_, state_.record.plan)));
    std::vector<EstimateRow>& rows = state_.record.rows;
    rows.push_back(estimated(t, report, filter_, request_, scratch_));
    state_.record.step_seconds += watch.seconds();
    if (request_.dump) request_.dump(t, filter_.weighted());
    const Stopwatch selection;
    if (observed) filter_.select(t, rows.back().report);
    state_.record.step_seconds += selection.seconds();
  }

  Filter& filter_;
  const RunRequest& request_;
  OnCollapse on_collapse_;
  RunState state_;
  std::vector<double> scratch_;
};

}  // namespace

RunRecord run(Filter& filter, const Plan& plan, const Recording& recording, const RunRequest& request) {
  return Journey(filter, plan, request).along(recording);
}

}  // namespace mote

#pragma once
/// The law of Filter::keep(): a run that is broken off and resumed is the unbroken run, bit by bit. For tests.

#include <atomic>
#include <bit>
#include <memory>
#include <optional>
#include <string>

#include "mote/engine/run.hpp"

namespace mote::laws {

/// A checkpoint in memory that writes itself after every step and breaks the run off after `steps` of them.
class BreakingCheckpoint final : public Checkpoint {
 public:
  explicit BreakingCheckpoint(std::size_t steps) : steps_(steps), stop_(steps == 0) {}

  bool resume(const KeepRun& run) override {
    if (!kept_) return false;
    std::size_t at = 0;
    Archive archive = Archive::from(
        [&](void* data, std::size_t count) {
          std::copy_n(kept_->data() + at, count, static_cast<char*>(data));
          at += count;
        },
        kept_->size());
    run(archive);
    all_read_ = archive.left() == 0;
    return true;
  }
  void step_done(const KeepRun&) override { stop_ = ++done_ >= steps_; }
  void stopped(const KeepRun& run) override {
    kept_.emplace();
    Archive archive =
        Archive::to([&](const void* data, std::size_t count) { kept_->append(static_cast<const char*>(data), count); });
    run(archive);
  }

  /// Breaks no run off any more.
  void relent() {
    steps_ = ~std::size_t{0};
    stop_ = false;
  }
  const std::atomic<bool>& stop() const { return stop_; }
  /// Whether the run that resumed has read all that the other wrote.
  bool all_read() const { return all_read_; }

 private:
  std::size_t steps_;
  std::size_t done_ = 0;
  std::atomic<bool> stop_;
  bool all_read_ = false;
  std::optional<std::string> kept_;
};

/// Whether two numbers have the same bits; any two that are no numbers count as the same.
inline bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

inline bool same(const EstimateRow& a, const EstimateRow& b) {
  bool all = a.t == b.t && a.states.size() == b.states.size() && a.functions.size() == b.functions.size();
  for (std::size_t d = 0; all && d < a.states.size(); ++d)
    all = same(a.states[d].mean, b.states[d].mean) && same(a.states[d].sd, b.states[d].sd);
  for (std::size_t f = 0; all && f < a.functions.size(); ++f) all = same(a.functions[f], b.functions[f]);
  return all && same(a.report.log_evidence, b.report.log_evidence) && same(a.report.ess, b.report.ess) &&
         same(a.report.acceptance, b.report.acceptance) && a.report.burn_in == b.report.burn_in &&
         a.report.selected == b.report.selected && a.report.collapsed == b.report.collapsed;
}

/// Breaks a run off after every number of steps that it has, resumes it with a new filter of make(), and compares.
///
/// returns what differs first; empty if nothing does
template <class Make>
std::string broken_promise(const Make& make, const Plan& plan, const Recording& recording, const RunRequest& asked) {
  const auto ran = [&](BreakingCheckpoint* checkpoint) {
    RunRequest request = asked;
    request.checkpoint = checkpoint;
    request.stop = checkpoint == nullptr ? nullptr : &checkpoint->stop();
    const std::unique_ptr<Filter> filter = make();
    return run(*filter, plan, recording, request);
  };
  const RunRecord unbroken = ran(nullptr);
  for (std::size_t steps = 0; steps < unbroken.predicted_steps; ++steps) {
    const std::string where = "broken off after " + std::to_string(steps) + " steps: ";
    BreakingCheckpoint checkpoint(steps);
    if (!ran(&checkpoint).interrupted) return where + "went on";
    checkpoint.relent();
    const RunRecord resumed = ran(&checkpoint);
    if (!checkpoint.all_read()) return where + "left something unread";
    if (resumed.interrupted || resumed.predicted_steps != unbroken.predicted_steps) return where + "ended early";
    for (std::size_t k = 0; k < unbroken.rows.size(); ++k)
      if (!same(resumed.rows[k], unbroken.rows[k])) return where + "other estimates in row " + std::to_string(k);
  }
  return "";
}

}  // namespace mote::laws

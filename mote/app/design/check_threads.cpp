#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/compare/statistics.hpp"
#include "mote/app/design/check.hpp"
#include "mote/engine/run.hpp"

namespace mote {
namespace {

constexpr std::array<const char*, 3> kModels{"ungm", "bearings", "doa"};
constexpr long long kFrame = 3;  // directions of a frame of doa
constexpr int kRuns = 3;         // of which the quickest counts
constexpr double kThreadsBound = 0.15;
constexpr double kEnough = 2e6;  // particles moved in a run

std::vector<std::size_t> thread_counts(std::size_t most) {
  std::vector<std::size_t> all;
  for (std::size_t k = 1; k < most; k *= 2) all.push_back(k);
  all.push_back(most);
  return all;
}

using compare::median;

/// A model's steps on a number of threads, by rounds.
struct Rounds {
  std::vector<double> predicted, measured, ratios;
};

class Bench {
 public:
  Bench(const char* model, const ThreadsCheck& check, std::string where, const CheckProgress& progress)
      : model_(find_model(model, where).make(Settings(where, {}), frame_header(kFrame))),
        check_(check),
        where_(std::move(where)),
        progress_(progress),
        recording_(simulated_scene(*model_, static_cast<Step>(steps_of(check.particles / 2)), 1).recording) {}

  void round(std::size_t threads, Rounds& all) const {
    const std::size_t n = check_.particles;
    const double half = step_seconds(n / 2, threads);
    const double whole = step_seconds(n, threads);
    const double twice = step_seconds(2 * n, threads);
    const double law = half + (twice - half) / 3;  // on the line through both, at n
    all.predicted.push_back(law);
    all.measured.push_back(whole);
    all.ratios.push_back(whole / law);
  }

 private:
  static std::size_t steps_of(std::size_t particles) {
    return static_cast<std::size_t>(std::clamp(kEnough / static_cast<double>(particles), 10.0, 1000.0));
  }

  double step_seconds(std::size_t particles, std::size_t threads) const {
    Plan plan;
    plan.particles = particles;
    plan.threads = threads;
    plan.on_collapse = OnCollapse::kKeep;
    Recording recording = recording_;
    recording.steps.resize(std::min(recording.steps.size(), steps_of(particles)));
    RunRequest request;
    request.where = where_;
    request.states = model_->states();
    double least = kInfinity;
    for (int k = 0; k < kRuns; ++k) {
      const auto filter = model_->filter(plan, where_);
      const RunRecord record = run(*filter, plan, recording, request);
      least = std::min(least, record.step_seconds / static_cast<double>(record.predicted_steps));
    }
    progress_();
    return least;
  }

  std::unique_ptr<CatalogueModel> model_;
  ThreadsCheck check_;
  std::string where_;
  const CheckProgress& progress_;
  Recording recording_;
};

}  // namespace

std::size_t measurements_of(const ThreadsCheck& check) {
  return kModels.size() * thread_counts(check.most_threads).size() * static_cast<std::size_t>(check.rounds) * 3;
}

std::vector<PredictionCheck> check_threads(const ThreadsCheck& check, const std::string& where,
                                           const CheckProgress& progress) {
  const std::vector<std::size_t> threads = thread_counts(check.most_threads);
  std::vector<PredictionCheck> all;
  for (const char* model : kModels) {
    const Bench bench(model, check, where, progress);
    std::vector<Rounds> rounds(threads.size());
    for (int k = 0; k < check.rounds; ++k)
      for (std::size_t i = 0; i < threads.size(); ++i) bench.round(threads[i], rounds[i]);
    std::size_t chosen = 0;
    for (std::size_t i = 1; i < threads.size(); ++i)
      if (median(rounds[i].predicted) < median(rounds[chosen].predicted)) chosen = i;
    const Rounds& best = rounds[chosen];
    all.push_back({fmt::format("{}, sisr, N = {}, {} thread{}: a step, us", model, check.particles, threads[chosen],
                               threads[chosen] == 1 ? "" : "s"),
                   1e6 * median(best.predicted), 1e6 * median(best.measured), median(best.ratios), kThreadsBound});
  }
  return all;
}

}  // namespace mote

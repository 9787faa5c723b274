#include <algorithm>

#include <fmt/format.h>

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/explore/filters.hpp"
#include "mote/app/explore/target.hpp"
#include "mote/engine/run.hpp"
#include "mote/software/threads.hpp"

namespace mote::explore {
namespace {

/// Particles from which threads have enough to do (software/threads.hpp).
constexpr std::size_t kWorthThreads = 32768;
/// Beyond these a filter that no vectors compute is not tried, unless it is asked for.
constexpr std::size_t kMostSlow = 16384;
constexpr std::size_t kTimedSteps = 10;

class Processor final : public Target {
 public:
  Processor(const Space& space, const Recording& timed) : space_(space), timed_(timed) {
    timed_.steps.resize(std::min(timed_.steps.size(), kTimedSteps));
    std::vector<Words> all;
    for (const std::string& kind : filters_of(space_))
      for (const std::size_t n : particles())
        for (const char* precision : {"double", "float"})
          for (const std::size_t threads : threads_for(n)) all.push_back(words_of(kind, n, precision, threads));
    if (space_.particles.empty())
      std::erase_if(all, [](const Words& words) {
        const Plan plan = plan_of(words);
        return plan.particles > kMostSlow && !simd_has(plan);
      });
    candidates_ =
        accepted(space_, all, "filters with particles and threads", [&](const Words& words) { make(plan_of(words)); });
  }

  std::string name() const override { return "cpu"; }
  std::string meaning() const override { return "time measured on this machine, with nothing else going on"; }
  std::vector<Figure> figures() const override {
    return {{"time", "s", "--deadline"}, {"threads", "", "--max-workers"}};
  }
  const std::vector<Words>& candidates() const override { return candidates_; }
  bool measures() const override { return true; }

  std::vector<double> takes(std::size_t c, Memory& memory) const override {
    const Plan plan = plan_of(candidates_[c]);
    return memory.recall(fmt::format("{}", fmt::join(candidates_[c], " ")), figures().size(), [&] {
      return std::vector<double>{seconds_per_step(plan), static_cast<double>(plan.threads)};
    });
  }
  RunRecord run(std::size_t c, const Recording& recording, std::uint64_t seed) const override {
    return run_alone(space_, plan_of(candidates_[c]), recording, seed);
  }
  std::string command(std::size_t c, const std::string& data) const override {
    return run_command_of(space_, candidates_[c], data);
  }

 private:
  std::vector<std::size_t> particles() const {
    if (!space_.particles.empty()) return space_.particles;
    return {64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768, 65536};
  }
  std::vector<std::size_t> threads_for(std::size_t n) const {
    if (!space_.workers.empty()) return space_.workers;
    if (n < kWorthThreads || cores() == 1) return {1};
    return {1, cores()};
  }
  std::unique_ptr<Filter> make(const Plan& plan) const { return space_.catalogue_model->filter(plan, space_.where); }
  static Plan plan_of(const Words& words) { return plan_from(arguments_from("mote run", plan_options(), words)); }

  static Words words_of(const std::string& kind, std::size_t n, const std::string& precision, std::size_t threads) {
    Words words = words_in(kind);
    words.insert(words.end(), {"--particles", std::to_string(n)});
    if (precision != "double") words.insert(words.end(), {"--precision", precision});
    words.insert(words.end(), {"--threads", std::to_string(threads)});
    return words;
  }

  /// The quickest of several rounds, each long enough for the clock; a slow filter has fewer of them.
  double seconds_per_step(const Plan& plan) const {
    constexpr double kRound = 0.01;   // seconds
    constexpr double kEnough = 0.25;  // seconds
    constexpr int kRounds = 9;
    double quickest = kInfinity;
    double spent = 0;
    for (int round = 0; round < kRounds && (round < 1 || spent < kEnough); ++round) {
      double seconds = 0;
      std::size_t steps = 0;
      while (seconds < kRound) {
        const RunRecord record = run_planned(space_, plan, timed_);
        seconds += record.step_seconds;
        steps += record.predicted_steps;
      }
      spent += seconds;
      quickest = std::min(quickest, seconds / static_cast<double>(steps));
    }
    return quickest;
  }

  Space space_;
  Recording timed_;
  std::vector<Words> candidates_;
};

}  // namespace

std::unique_ptr<Target> processor(const Space& space, const Recording& timed) {
  return std::make_unique<Processor>(space, timed);
}

}  // namespace mote::explore

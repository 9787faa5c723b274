// Resampling alone: weights of the kind that a growth-model filter has, ancestors, and their states copied.

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "mote/app/bench/task_list.hpp"
#include "mote/base/draws.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote::bench {
namespace {

/// Weights exp(-z^2 / 2), z ~ N(0, 4): an effective sample size of 0.6 N.
std::vector<double> trial_weights(std::size_t particles) {
  std::vector<double> weights(particles);
  Draws{1, 0}.for_each<double>(Purpose::kTest, 0, particles, [&](std::size_t i, auto& draw) {
    const double z = 2 * draw.normal();
    weights[i] = std::exp(-z * z / 2);
  });
  return weights;
}

/// Particle i has the state i.
class ResampleRacer : public Racer {
 public:
  void prepare(std::size_t particles, std::uint64_t seed) override {
    seed_ = seed;
    if (weights_.size() == particles) return;
    weights_ = trial_weights(particles);
    states_.resize(particles);
    std::iota(states_.begin(), states_.end(), 0.0);
  }

 protected:
  std::vector<double> weights_, states_;
  std::uint64_t seed_ = 0;
};

class SchemeRacer final : public ResampleRacer {
 public:
  explicit SchemeRacer(const Scheme& scheme) : scheme_(&scheme) {}

  void run(std::vector<double>& answer) override {
    ancestors_.resize(weights_.size());
    answer.resize(weights_.size());
    scheme_->resample(weights_, Draws{seed_, 1}, ancestors_);
    for (std::size_t j = 0; j < answer.size(); ++j) answer[j] = states_[ancestors_[j]];
  }

 private:
  const Scheme* scheme_;
  std::vector<std::uint32_t> ancestors_;
};

/// Systematic resampling as a user writes it: one loop, nothing for the last digit.
class WalkRacer final : public ResampleRacer {
 public:
  void run(std::vector<double>& answer) override {
    answer.resize(weights_.size());
    const double stride = std::accumulate(weights_.begin(), weights_.end(), 0.0) / static_cast<double>(weights_.size());
    double target = Draws{seed_, 1}.uniform(Purpose::kSelect) * stride;
    double through = weights_[0];
    std::size_t parent = 0;
    for (double& child : answer) {
      while (through < target && parent + 1 < weights_.size()) through += weights_[++parent];
      child = states_[parent];
      target += stride;
    }
  }
};

// claim    particle i has N W_i children in the mean
// design   200 seeds, 1000 particles; z_i = (mean - N W_i) / sqrt(N W_i / 200) over the particles with N W_i >= 0.05.
// With
//          multinomial resampling the mean of z^2 is 1, with a standard error of sqrt(2 / 700) = 0.05; others vary
//          less. metropolis is off by 1e-4 in total variation, far below that
// risk     1.3 is 6 standard errors up; children in proportion to other weights give ten and more
Verdict fair(const Entrant& entrant) {
  constexpr std::size_t kParticles = 1000;
  constexpr std::uint64_t kRuns = 200;
  const auto racer = entrant.make();
  std::vector<double> children(kParticles);
  std::vector<double> answer;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    racer->prepare(kParticles, seed);
    racer->run(answer);
    for (const double state : answer) children[static_cast<std::size_t>(state)] += 1;
  }
  const auto weights = trial_weights(kParticles);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  double squares = 0;
  double counted = 0;
  for (std::size_t i = 0; i < kParticles; ++i) {
    const double expected = kParticles * weights[i] / total;
    if (expected < 0.05) continue;
    squares += std::pow(children[i] / kRuns - expected, 2) / (expected / kRuns);
    counted += 1;
  }
  return {fmt::format("mean square error of the mean numbers of children, in multinomial variances, {} runs", kRuns),
          squares / counted, 0, 1.3};
}

}  // namespace

/// Bytes: weights read twice (8 each), ancestors written and read (4 each), states read and children written (8 each);
/// what single schemes add to that is not counted. The walk needs no ancestors.
Task resample_task(const TaskEntry& entry, std::size_t) {
  Task task{entry.name, entry.meaning, Clock::kThread, 1, {}, fair};
  for (const Scheme& scheme : schemes())
    task.entrants.push_back({std::string(scheme.name), std::string(scheme.meaning), 40, "",
                             [&scheme] { return std::make_unique<SchemeRacer>(scheme); }});
  task.entrants.push_back(
      {"baseline", "systematic as a user writes it, one loop", 32, "", [] { return std::make_unique<WalkRacer>(); }});
  return task;
}

}  // namespace mote::bench

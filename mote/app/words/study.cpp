#include "mote/app/words/study.hpp"

#include <algorithm>
#include <cmath>

#include "mote/app/words/companion.hpp"
#include "mote/app/words/pairs.hpp"
#include "mote/base/refusal.hpp"
#include "mote/filter/sisr.hpp"

namespace mote {
namespace {

double squared(double difference, bool angle) {
  const double d = angle ? numbers::wrap(difference) : difference;
  return d * d;
}

/// Steps that a filter predicts.
std::size_t steps_of(const Recording& recording) {
  return recording.steps.empty() ? 0 : static_cast<std::size_t>(recording.steps.back().t);
}

}  // namespace

bool can_be_drawn(const CatalogueModel& model) {
  try {
    simulated_scene(model, 1, 1);
    return true;
  } catch (const Refusal&) {
    return false;
  }
}

WordStudy::WordStudy(const CatalogueModel& model, const WordStudyDesign& design, std::size_t first)
    : design_(design), first_(first), recorded_(model.recorded(design.proposal, design.where)) {
  if (design.given.empty() || can_be_drawn(model))
    for (std::size_t k = 0; k < design.recordings; ++k)
      scenes_.push_back(simulated_scene(model, design.steps, design.seed + first + k));
  for (const Recording& recording : design.given) scenes_.push_back({recording, {}});
  const auto watched = std::make_shared<graph::WatchedArithmetic>(recorded_.graph);
  squares(watched);
  seen_ = watched->seen();
}

/// Of a long recording fewer: it is to take no longer than all others.
std::size_t WordStudy::particles_of(const Scene& scene) const {
  constexpr std::size_t kFewest = 25;
  constexpr std::size_t kMoves = 100'000;
  const std::size_t most = kMoves / std::max<std::size_t>(1, steps_of(scene.recording));
  return scene.truth.states.empty() ? std::min(design_.particles, std::max(kFewest, most)) : design_.particles;
}

std::size_t WordStudy::calls() const {
  std::size_t calls = 0;
  for (const Scene& scene : scenes_) calls += particles_of(scene) * steps_of(scene.recording);
  return calls;
}

graph::Ranges WordStudy::ranges() const { return graph::ranges(recorded_, seen_, design_.margin); }

hardware::Samples WordStudy::samples() const {
  constexpr std::size_t kKept = 4096;
  const std::size_t stride = calls() / kKept + 1;
  const auto sampling = std::make_shared<hardware::SampledArithmetic>(recorded_, stride, kKept);
  std::vector<double> errors = squares(sampling).errors;
  std::size_t estimates = 0;
  for (const Scene& scene : scenes_) estimates += scene.truth.states.size();
  for (double& error : errors) error = estimates == 0 ? 0 : std::sqrt(error / static_cast<double>(estimates));
  hardware::Samples samples{sampling->samples().calls, errors};
  if (recorded_.log_ratio) {
    PairSampling pairs(recorded_, stride, kKept);
    for (std::size_t k = 0; k < scenes_.size(); ++k)
      pairs.filter(scenes_[k].recording, particles_of(scenes_[k]), design_.seed + first_ + k);
    samples.calls[static_cast<std::size_t>(hardware::Part::kNext)] = pairs.moves();
    samples.calls[static_cast<std::size_t>(hardware::Part::kWeigh)] = pairs.weighings();
  }
  return samples;
}

double WordStudy::error_ratio(const graph::FixedPoint& point) const {
  const Squares both = squares(std::make_shared<graph::FixedArithmetic>(recorded_.graph, point));
  double worst = 0;
  for (std::size_t d = 0; d < both.errors.size(); ++d)
    worst = std::max(worst, std::sqrt(1 + both.differences[d] / both.errors[d]));
  return worst;
}

template <class A>
WordStudy::Squares WordStudy::squares(const std::shared_ptr<A>& arithmetic) const {
  const Accompanied<A> model(recorded_, arithmetic);
  const std::size_t states = recorded_.states.size();
  Squares squares{std::vector<double>(states), std::vector<double>(states)};
  for (std::size_t k = 0; k < scenes_.size(); ++k) {
    const auto& truths = scenes_[k].truth.states;
    const auto filter = make_sisr(model, particles_of(scenes_[k]), design_.seed + first_ + k, {}, OnCollapse::kKeep);
    for (const ObservedStep& step : scenes_[k].recording.steps) {
      StepReport report = filter->update(step.t, step.rows);
      const auto truth = truths.find(step.t);
      const WeightedSet set = filter->weighted();
      const std::vector<double> weights = model.weights_of_other(step.t, step.rows, set);
      const WeightedSet other{set.particles, weights,
                              ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; })};
      for (std::size_t d = 0; d < states; ++d) {
        const bool angle = recorded_.states[d].angle;
        const double mean = component_moments(set, d, angle).mean;
        if (truth != truths.end()) squares.errors[d] += squared(mean - truth->second[d], angle);
        squares.differences[d] += squared(component_moments(other, states + d, angle).mean - mean, angle);
      }
      filter->select(step.t, report);
    }
  }
  return squares;
}

}  // namespace mote

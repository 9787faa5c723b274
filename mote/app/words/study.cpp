#include "mote/app/words/study.hpp"

#include <algorithm>
#include <cmath>

#include "mote/app/words/companion.hpp"
#include "mote/app/words/pairs.hpp"
#include "mote/filter/sisr.hpp"

namespace mote {
namespace {

double squared(double difference, bool angle) {
  const double d = angle ? numbers::wrap(difference) : difference;
  return d * d;
}

}  // namespace

WordStudy::WordStudy(const CatalogueModel& model, const WordStudyDesign& design, std::size_t first)
    : design_(design), first_(first), recorded_(model.recorded(design.proposal, design.where)) {
  for (std::size_t k = 0; k < design.recordings; ++k)
    scenes_.push_back(simulated_scene(model, design.steps, design.seed + first + k));
  const auto watched = std::make_shared<graph::WatchedArithmetic>(recorded_.graph);
  squares(watched);
  seen_ = watched->seen();
}

graph::Ranges WordStudy::ranges() const { return graph::ranges(recorded_, seen_, design_.margin); }

hardware::Samples WordStudy::samples() const {
  constexpr std::size_t kKept = 4096;
  const std::size_t calls = design_.particles * static_cast<std::size_t>(design_.steps) * scenes_.size();
  const auto sampling = std::make_shared<hardware::SampledArithmetic>(recorded_, calls / kKept + 1, kKept);
  std::vector<double> errors = squares(sampling).errors;
  const auto estimates = static_cast<double>(scenes_.size() * static_cast<std::size_t>(design_.steps));
  for (double& error : errors) error = std::sqrt(error / estimates);
  hardware::Samples samples{sampling->samples().calls, errors};
  if (recorded_.log_ratio) {
    PairSampling pairs(recorded_, calls / kKept + 1, kKept);
    for (std::size_t k = 0; k < scenes_.size(); ++k)
      pairs.filter(scenes_[k].recording, design_.particles, design_.seed + first_ + k);
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
    const auto filter = make_sisr(model, design_.particles, design_.seed + first_ + k, {}, OnCollapse::kKeep);
    for (const ObservedStep& step : scenes_[k].recording.steps) {
      StepReport report = filter->update(step.t, step.rows);
      const std::vector<double>& truth = scenes_[k].truth.states.at(step.t);
      const WeightedSet set = filter->weighted();
      const std::vector<double> weights = model.weights_of_other(step.t, step.rows, set);
      const WeightedSet other{set.particles, weights,
                              ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; })};
      for (std::size_t d = 0; d < states; ++d) {
        const bool angle = recorded_.states[d].angle;
        const double mean = component_moments(set, d, angle).mean;
        squares.errors[d] += squared(mean - truth[d], angle);
        squares.differences[d] += squared(component_moments(other, states + d, angle).mean - mean, angle);
      }
      filter->select(step.t, report);
    }
  }
  return squares;
}

}  // namespace mote

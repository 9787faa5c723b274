#include "mote/app/words/study.hpp"

#include <algorithm>
#include <cmath>

#include "mote/filter/sisr.hpp"
#include "mote/graph/replay.hpp"

namespace mote {

WordStudy::WordStudy(const CatalogueModel& model, const WordStudyDesign& design, std::size_t first)
    : design_(design), first_(first), recorded_(model.recorded()) {
  for (std::size_t k = 0; k < design.recordings; ++k)
    scenes_.push_back(simulated_scene(model, design.steps, design.seed + first + k));
  const auto watched = std::make_shared<graph::WatchedArithmetic>(recorded_.graph);
  double_errors_ = errors(watched);
  seen_ = watched->seen();
}

graph::Ranges WordStudy::ranges() const { return graph::ranges(recorded_, seen_, design_.margin); }

hardware::Samples WordStudy::samples() const {
  constexpr std::size_t kKept = 4096;
  const std::size_t calls = design_.particles * static_cast<std::size_t>(design_.steps) * scenes_.size();
  const auto sampling = std::make_shared<hardware::SampledArithmetic>(recorded_, calls / kKept + 1, kKept);
  hardware::Samples samples{{}, errors(sampling)};
  samples.calls = sampling->samples().calls;
  return samples;
}

double WordStudy::error_ratio(const graph::FixedPoint& point) const {
  const auto fixed = errors(std::make_shared<graph::FixedArithmetic>(recorded_.graph, point));
  double worst = 0;
  for (std::size_t d = 0; d < fixed.size(); ++d) worst = std::max(worst, fixed[d] / double_errors_[d]);
  return worst;
}

template <class A>
std::vector<double> WordStudy::errors(const std::shared_ptr<A>& arithmetic) const {
  const graph::Replayed<A> model(recorded_, arithmetic);
  std::vector<double> squares(recorded_.states.size());
  for (std::size_t k = 0; k < scenes_.size(); ++k) {
    const auto filter = make_sisr(model, design_.particles, design_.seed + first_ + k, {}, OnCollapse::kKeep);
    for (const ObservedStep& step : scenes_[k].recording.steps) {
      StepReport report = filter->update(step.t, step.rows);
      const std::vector<double>& truth = scenes_[k].truth.states.at(step.t);
      for (std::size_t d = 0; d < squares.size(); ++d) {
        const bool angle = recorded_.states[d].angle;
        const double error = filter->moments(d, angle).mean - truth[d];
        squares[d] += angle ? std::pow(numbers::wrap(error), 2) : error * error;
      }
      filter->select(step.t, report);
    }
  }
  for (double& sum : squares)
    sum = std::sqrt(sum / static_cast<double>(scenes_.size() * static_cast<std::size_t>(design_.steps)));
  return squares;
}

}  // namespace mote

#include "mote/app/words/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mote/base/draws.hpp"
#include "mote/base/log_weights.hpp"
#include "mote/base/normal.hpp"
#include "mote/filter/resample/schemes.hpp"
#include "mote/graph/evaluate.hpp"

namespace mote {
namespace {

using graph::Role;
using graph::Vertex;

/// Draws of a recording, in the order in which it takes them.
template <class Draw>
std::vector<double> drawn(const std::vector<bool>& normal, Draw& draw) {
  std::vector<double> all;
  for (const bool is_normal : normal) all.push_back(is_normal ? draw.normal() : draw.uniform());
  return all;
}

std::vector<double> taken(const std::vector<double>& values, const std::vector<graph::Id>& ids) {
  std::vector<double> all;
  for (const graph::Id id : ids) all.push_back(values[id]);
  return all;
}

/// Whether a step has a row, and all of it was seen.
bool is_whole(const ObservedStep& step) {
  if (step.rows.empty()) return false;
  const auto& present = step.rows.front().present;
  return std::all_of(present.begin(), present.end(), [](bool seen) { return seen; });
}

/// Which draws a pair takes: those of the proposal, and of the model's own move what that has more.
std::vector<bool> draws_of(const graph::Recorded& recorded) {
  std::vector<bool> normal = recorded.proposal_draws;
  for (std::size_t k = normal.size(); k < recorded.draws.size(); ++k) normal.push_back(recorded.draws[k]);
  return normal;
}

/// A draw as an input has it: the model's own move may read as normal what the proposal reads as uniform.
double as(Role role, bool normal, double number) {
  if (role == Role::kNormal && !normal) return standard_normal_quantile(number);
  if (role == Role::kUniform && normal) return 0.5 * std::erfc(-number / std::sqrt(2.0));
  return number;
}

}  // namespace

template <class Draw>
PairSampling::State PairSampling::prior(Draw& draw) const {
  const std::vector<double> numbers = drawn(recorded_->prior_draws, draw);
  std::vector<double> values;
  graph::evaluate(
      recorded_->graph,
      [&](const Vertex& v) {
        return v.role == Role::kPriorNormal || v.role == Role::kPriorUniform ? numbers[v.index] : 0.0;
      },
      values);
  return taken(values, recorded_->initial);
}

template <class Draw>
PairSampling::Pair PairSampling::proposed(const State& before, const Row<double>& row,
                                          const std::vector<double>& schedule, Draw& draw) {
  const std::vector<bool> normal = draws_of(*recorded_);
  const std::vector<double> numbers = drawn(normal, draw);
  State x(before.size());
  std::vector<double> values;
  const auto input = [&](const Vertex& v) {
    if (v.role == Role::kBefore) return before[v.index];
    if (v.role == Role::kState) return x[v.index];
    if (v.role == Role::kColumn) return row[v.index];
    if (v.role == Role::kSchedule) return schedule[v.index];
    if (v.role != Role::kNormal && v.role != Role::kUniform) return 0.0;
    return as(v.role, normal[v.index], numbers[v.index]);
  };
  graph::evaluate(recorded_->graph, input, values);
  const bool kept = count_++ % stride_ == 0 && moves_.size() < most_;
  if (kept) moves_.push_back(values);
  x = taken(values, recorded_->proposed);
  graph::evaluate(recorded_->graph, input, values);
  if (kept) weighings_.push_back(values);
  const double log_weight = values[recorded_->log_likelihood] + values[*recorded_->log_ratio];
  return {std::move(x), std::isfinite(log_weight) ? log_weight : -kInfinity};
}

void PairSampling::filter(const Recording& recording, std::size_t particles, std::uint64_t seed) {
  std::vector<State> parents(particles);
  Draws{seed, 0}.for_each(Purpose::kPrior, 0, particles, [&](std::size_t i, auto& draw) { parents[i] = prior(draw); });
  for (const ObservedStep& step : recording.steps) {
    if (!is_whole(step)) continue;
    const Draws draws{seed, static_cast<std::uint32_t>(step.t)};
    const std::vector<double> schedule = recorded_->schedule(step.t);
    std::vector<State> proposals(particles);
    std::vector<double> log_weights(particles);
    draws.for_each(Purpose::kMove, 0, particles, [&](std::size_t i, auto& draw) {
      const Pair pair = proposed(parents[i], step.rows.front(), schedule, draw);
      proposals[i] = pair.x;
      log_weights[i] = pair.log_weight;
    });
    std::vector<double> weights(particles);
    if (!(exponentiate(log_weights, log_sum_exp(log_weights).largest, weights) > 0)) return;
    std::vector<std::uint32_t> ancestors(particles);
    systematic(weights, draws, ancestors);
    for (std::size_t i = 0; i < particles; ++i) parents[i] = proposals[ancestors[i]];
  }
}

}  // namespace mote

#include "mote/app/reproduce/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;
using Values = std::vector<std::vector<double>>;  // (R, n)

double mean_at(const Values& values, std::size_t t) {
  double sum = 0;
  for (const auto& repeat : values) sum += repeat[t];
  return sum / static_cast<double>(values.size());
}

double variance_at(const Values& values, std::size_t t) {
  const double mean = mean_at(values, t);
  double squares = 0;
  for (const auto& repeat : values) squares += (repeat[t] - mean) * (repeat[t] - mean);
  return squares / static_cast<double>(values.size() - 1);
}

double median(const Values& values) {
  std::vector<double> sorted;
  for (const auto& repeat : values) sorted.push_back(repeat.front());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

double mean_difference(Comparison::Unit unit, const Samples& samples) {
  const Values& a = samples.values[0];
  const Values& b = samples.values[1];
  double squares = 0;
  double variances = 0;
  const std::size_t steps = a.front().size();
  for (std::size_t t = 0; t < steps; ++t) {
    double difference = mean_at(a, t) - mean_at(b, t);
    if (unit == Comparison::Unit::kPosteriorSd) difference /= mean_at(samples.sds, t);
    squares += difference * difference;
    variances += variance_at(a, t) + variance_at(b, t);
  }
  if (unit == Comparison::Unit::kStandardError)
    return std::sqrt(squares / (variances / static_cast<double>(samples.repeats())));
  return std::sqrt(squares / static_cast<double>(steps));
}

/// Root of the mean variance: over time, or of a single number.
double spread(const Values& values) {
  double variances = 0;
  const std::size_t n = values.front().size();
  for (std::size_t t = 0; t < n; ++t) variances += variance_at(values, t);
  return std::sqrt(variances / static_cast<double>(n));
}

/// The least number of particles from which on the mean error stays near that of the most.
double enough(const Comparison& c, const Values& errors, const std::vector<double>& particles) {
  std::size_t least = particles.size() - 1;
  const double near = (1 + c.slack) * mean_at(errors, least);
  while (least > 0 && mean_at(errors, least - 1) <= near) --least;
  return std::isfinite(near) ? particles[least] : kNaN;
}

double of_one_run(const Comparison& c, const Samples& samples, std::size_t side) {
  const Values& values = samples.values[side];
  if (c.kind == Kind::kParticlesEnough) return enough(c, values, samples.particles[side]);
  if (c.kind == Kind::kMeanSpread || c.kind == Kind::kEvidenceSpread) return spread(values);
  if (c.kind == Kind::kNormalisedError) return std::sqrt(mean_at(values, 0));
  return c.median ? median(values) : mean_at(values, 0);
}

Samples without(const Samples& samples, std::size_t repeat) {
  Samples rest = samples;
  const auto at = static_cast<std::ptrdiff_t>(repeat);
  for (Values& values : rest.values) values.erase(values.begin() + at);
  if (!rest.sds.empty()) rest.sds.erase(rest.sds.begin() + at);
  return rest;
}

/// Each run's repeats at the given places.
Samples drawn(const Samples& samples, std::span<const std::size_t> places) {
  Samples some;
  for (const Values& values : samples.values) {
    Values& kept = some.values.emplace_back();
    for (const std::size_t r : places) kept.push_back(values[r]);
  }
  return some;
}

}  // namespace

double bearing_rmse(const RunRecord& run, const Truth& truth, std::size_t x, std::size_t y) {
  double squares = 0;
  double count = 0;
  for (const EstimateRow& row : run.rows) {
    const auto known = truth.states.find(row.t);
    if (known == truth.states.end()) continue;
    const double there = std::atan2(known->second[y], known->second[x]);
    const double error = numbers::wrap(std::atan2(row.states[y].mean, row.states[x].mean) - there);
    squares += error * error;
    ++count;
  }
  return std::sqrt(squares / count);
}

double statistic(const Comparison& c, const Samples& samples) {
  if (c.kind == Kind::kMeanDifference) return mean_difference(c.unit, samples);
  const double first = of_one_run(c, samples, 0);
  if (c.kind == Kind::kRecovered) return (first - of_one_run(c, samples, 1)) / (first - of_one_run(c, samples, 2));
  return samples.values.size() == 2 ? first / of_one_run(c, samples, 1) : first;
}

std::optional<double> standard_error(const Comparison& c, const Samples& samples) {
  const bool judges_itself = c.kind == Kind::kMeanDifference && c.unit == Comparison::Unit::kStandardError;
  const bool counts = c.kind == Kind::kParticlesEnough;
  if (c.median || judges_itself || counts || samples.repeats() < 3) return std::nullopt;
  const std::size_t n = samples.repeats();
  Values left;
  for (std::size_t r = 0; r < n; ++r) left.push_back({statistic(c, without(samples, r))});
  const auto count = static_cast<double>(n);
  return (count - 1) / std::sqrt(count) * spread(left);
}

std::optional<compare::Interval> interval(const Comparison& c, const Samples& samples) {
  if (!c.median) return std::nullopt;
  const compare::Interval ends = compare::bootstrap({samples.repeats(), 1}, [&](std::span<const std::size_t> places) {
    return statistic(c, drawn(samples, places));
  });
  if (std::isnan(ends.low)) return std::nullopt;
  return ends;
}

}  // namespace mote::reproduce

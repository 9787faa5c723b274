#include "mote/app/reproduce/laboratory.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mote/app/reproduce/faults.hpp"

namespace mote::reproduce {

using Kind = Comparison::Kind;

Laboratory::Laboratory(Item item) : item_(std::move(item)) {
  as_bad_data([&] {
    if (item_.weights)
      weights_ = std::make_unique<Weights>(item_);
    else if (item_.clip)
      cinema_ = std::make_unique<Cinema>(item_);
    else if (item_.cluster)
      clusters_ = std::make_unique<Clusters>(item_);
    else if (item_.design)
      designs_ = std::make_unique<Designs>(item_);
    else if (item_.analog)
      analogs_ = std::make_unique<Analogs>(item_);
    else
      filters_ = std::make_unique<Filters>(item_);
  });
}

std::string Laboratory::missing() const {
  if (clusters_) return clusters_->missing();
  if (analogs_) return analogs_->missing();
  if (filters_) return filters_->missing();
  const std::string clip = cinema_ ? cinema_->missing() : "";
  return clip.empty() ? "" : fmt::format("there is no {}. Set MOTE_DATA to the folder with clips/.", clip);
}

std::vector<std::function<void()>> Laboratory::errands() {
  return filters_ ? filters_->errands() : std::vector<std::function<void()>>();
}

std::size_t Laboratory::work() const {
  if (cinema_) return cinema_->work();
  if (clusters_) return clusters_->work();
  if (designs_) return designs_->work();
  if (analogs_) return analogs_->work();
  if (filters_) return filters_->work();
  std::size_t resamplings = 0;
  for (const Comparison& c : item_.comparisons) resamplings += c.runs.size() * static_cast<std::size_t>(c.repeats);
  return resamplings;
}

std::vector<double> Laboratory::sample(const Comparison& c, std::uint64_t repeat, std::size_t side) {
  if (cinema_) return cinema_->sample(c, repeat, side, ran_);
  if (clusters_) return {clusters_->figure(c, side, ran_)};
  if (designs_) return {designs_->figure(c, side)};
  if (analogs_) return {analogs_->figure(c, side, ran_)};
  if (filters_) return filters_->sample(c, repeat, side, ran_);
  const double figure = weights_->figure(c, repeat, side);
  ran_();
  return {figure};
}

Samples Laboratory::samples_of(const Comparison& c) {
  Samples samples;
  samples.values.resize(c.kind == Kind::kNormalisedError ? 1 : c.runs.size());
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(c.repeats); ++r)  // outside, so that times are paired
    for (std::size_t side = 0; side < samples.values.size(); ++side) samples.values[side].push_back(sample(c, r, side));
  if (c.kind == Kind::kParticlesEnough)
    for (const std::string& series : c.runs) samples.particles.push_back(cinema_->particles_of(series));
  if (c.kind == Kind::kMeanDifference && c.unit == Comparison::Unit::kPosteriorSd)
    samples.sds = filters_->posterior_sds(c);
  return samples;
}

Result Laboratory::judged(const Comparison& c) {
  Result result;
  result.asked = c;
  result.ours = kNaN;
  try {
    const Samples samples = samples_of(c);
    result.ours = statistic(c, samples);
    result.standard_error = standard_error(c, samples);
    result.interval = interval(c, samples);
  } catch (const Refusal& refusal) {
    if (refusal.code() != ExitCode::kCollapsed) throw;
  }
  if (const auto* paper = std::get_if<double>(&c.paper); paper != nullptr && *paper != 0)
    result.ratio = result.ours / *paper;
  result.holds = !std::isnan(result.ours) && result.ours >= c.at_least.value_or(-kInfinity) &&
                 result.ours <= c.at_most.value_or(kInfinity) &&
                 (!c.within || std::abs(*result.ratio - 1) <= *c.within);
  return result;
}

void Laboratory::run_filters(Outcome& outcome) {
  Runs& runs = filters_->runs();
  outcome.states = runs.states();
  outcome.truth = runs.scene(0).truth;
  for (const ObservedStep& step : runs.scene(0).recording.steps) outcome.times.push_back(step.t);
  for (const Run& run : item_.runs) try {
      ran_();
      outcome.records.emplace_back(run.name, runs.record(run.name, 0, 0));
    } catch (const Refusal& refusal) {
      if (refusal.code() != ExitCode::kCollapsed) throw;
      outcome.collapses.push_back(run.name + ": " + refusal.what());
    }
}

void Laboratory::show_clips(Outcome& outcome) {
  for (const Figure& figure : item_.figures)
    if (!figure.frames.empty()) outcome.pictures.push_back(cinema_->picture(figure, ran_));
  outcome.tracks = cinema_->rows();
}

Outcome Laboratory::regenerate(const std::function<void()>& ran) {
  ran_ = ran;
  Outcome outcome;
  if (filters_) run_filters(outcome);
  for (const Comparison& comparison : item_.comparisons)
    if (const std::string tool = filters_ ? filters_->missing_tool(comparison) : ""; !tool.empty()) {
      outcome.left_out.push_back(fmt::format("left out {}: {}", comparison.name, tool));
    } else {
      outcome.results.push_back(judged(comparison));
    }
  for (const Figure& figure : item_.figures)
    if (!figure.against.empty()) outcome.errors[figure.title] = filters_->errors_of(figure, ran_);
  if (weights_) outcome.tradeoffs = weights_->tradeoffs();
  if (cinema_) show_clips(outcome);
  if (clusters_) outcome.sweeps = clusters_->sweeps(ran_);
  if (designs_)
    for (const Figure& figure : item_.figures) outcome.curves[figure.title] = designs_->curves(figure);
  if (analogs_)
    for (const Figure& figure : item_.figures) outcome.drawn[figure.title] = analogs_->chart(figure, ran_);
  return outcome;
}

}  // namespace mote::reproduce

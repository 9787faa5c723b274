#include "mote/app/reproduce/laboratory.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/commands/plan_options.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;

/// A simulated recording with its truth.
struct Scene {
  Recording recording;
  Truth truth;
};

class Laboratory {
 public:
  explicit Laboratory(const Item& item) : item_(item) {
    for (int m = 1; m <= item.simulated.columns; ++m) header_.push_back("doa" + std::to_string(m));
    source_ = made(item.simulated.settings);
    states_ = source_->states();
  }

  const std::vector<Quantity>& states() const { return states_; }

  Scene scene(std::uint64_t seed) const {
    const Simulation simulation = source_->simulate(item_.simulated.steps, seed);
    Scene scene;
    for (const Column& column : source_->columns())
      if (!column.input) scene.recording.observations.push_back(column);
    scene.truth.known.assign(states_.size(), true);
    for (Step t = 1; t <= item_.simulated.steps; ++t) {
      scene.recording.steps.push_back({t, {simulation.rows[static_cast<std::size_t>(t - 1)]}});
      scene.truth.states[t] = simulation.states[static_cast<std::size_t>(t - 1)];
    }
    return scene;
  }

  RunRecord filtered(const std::string& name, const Scene& scene, std::uint64_t seed_offset) const {
    const Run& run = *std::find_if(item_.runs.begin(), item_.runs.end(), [&](const Run& r) { return r.name == name; });
    Plan plan = plan_from(arguments_from(item_.file + ": run \"" + name + "\"", plan_options(), run.options));
    plan.seed += seed_offset;
    Job job;
    job.model_name = item_.simulated.model;
    auto settings = item_.simulated.settings;
    for (const std::string& changed : run.settings) {
      const std::string key = changed.substr(0, changed.find('=') + 1);
      std::erase_if(settings, [&](const std::string& s) { return s.starts_with(key); });
      settings.push_back(changed);
    }
    job.model = made(settings);
    job.recording = scene.recording;
    return run_job(job, plan, request_for(job, {}, item_.file), item_.file);
  }

  double computed(const Comparison& c) const {
    switch (c.kind) {
      case Kind::kMeanDifference:
        return mean_difference(c);
      case Kind::kRmse:
        return mean_rmse(c, c.runs[0]);
      case Kind::kRmseRatio:
        return mean_rmse(c, c.runs[0]) / mean_rmse(c, c.runs[1]);
      case Kind::kNormalisedError:
        return normalised_error(c);
      case Kind::kEvidenceSpread:
        return evidence_spread(c);
    }
    return kNaN;
  }

 private:
  std::unique_ptr<CatalogueModel> made(const std::vector<std::string>& settings) const {
    return find_model(item_.simulated.model, item_.file).make(Settings(item_.file, settings), header_);
  }

  std::size_t place_of(const std::string& state) const {
    for (std::size_t d = 0; d < states_.size(); ++d)
      if (states_[d].name == state) return d;
    throw Refusal(ExitCode::kBadData,
                  {item_.file, "\"state\"", "a state of " + item_.simulated.model, "\"" + state + "\"", ""});
  }

  /// RMS over time of the difference of the repeats' mean estimates, over the RMS Monte-Carlo deviation of one such
  /// difference.
  double mean_difference(const Comparison& c) const {
    const Scene one = scene(item_.simulated.seed);
    const std::size_t d = place_of(c.state);
    const std::size_t steps = one.recording.steps.size();
    std::vector<std::vector<double>> sums(2, std::vector<double>(steps, 0));
    std::vector<std::vector<double>> squares = sums;
    const auto n = static_cast<double>(c.repeats);
    for (std::size_t side = 0; side < 2; ++side)
      for (int r = 0; r < c.repeats; ++r) {
        // the two sides get seeds of their own, so that they are independent
        const RunRecord record = filtered(c.runs[side], one, static_cast<std::uint64_t>(r) + 100000 * side);
        for (std::size_t k = 0; k < steps; ++k) {
          const double error = deviation(record.rows[k].states[d].mean, one.truth.states.at(record.rows[k].t)[d], d);
          sums[side][k] += error;
          squares[side][k] += error * error;
        }
      }
    double difference = 0;
    double deviation_of_one = 0;
    for (std::size_t k = 0; k < steps; ++k) {
      difference += std::pow((sums[0][k] - sums[1][k]) / n, 2);
      for (std::size_t side = 0; side < 2; ++side)
        deviation_of_one += (squares[side][k] - sums[side][k] * sums[side][k] / n) / (n - 1);
    }
    return std::sqrt(difference / deviation_of_one);
  }

  double mean_rmse(const Comparison& c, const std::string& run) const {
    double sum = 0;
    for (int r = 0; r < c.repeats; ++r) {
      const auto offset = static_cast<std::uint64_t>(r);
      const Scene one = scene(item_.simulated.seed + offset);
      const Summary s = summarise(filtered(run, one, offset), &one.truth);
      sum += c.state == "position" ? s.position_error.value().rmse : s.rmse[place_of(c.state)];
    }
    return sum / c.repeats;
  }

  double normalised_error(const Comparison& c) const {
    const std::size_t d = place_of(c.state);
    double squares = 0;
    double count = 0;
    for (int r = 0; r < c.repeats; ++r) {
      const auto offset = static_cast<std::uint64_t>(r);
      const Scene one = scene(item_.simulated.seed + offset);
      for (const EstimateRow& row : filtered(c.runs[0], one, offset).rows) {
        squares += std::pow(deviation(row.states[d].mean, one.truth.states.at(row.t)[d], d) / row.states[d].sd, 2);
        count += 1;
      }
    }
    return std::sqrt(squares / count);
  }

  double evidence_spread(const Comparison& c) const {
    const Scene one = scene(item_.simulated.seed);
    std::vector<double> evidences;
    for (int r = 0; r < c.repeats; ++r)
      evidences.push_back(summarise(filtered(c.runs[0], one, static_cast<std::uint64_t>(r)), nullptr).log_evidence);
    double mean = 0;
    double squares = 0;
    for (const double e : evidences) mean += e / c.repeats;
    for (const double e : evidences) squares += (e - mean) * (e - mean);
    return std::sqrt(squares / (c.repeats - 1));
  }

  double deviation(double estimate, double truth, std::size_t d) const {
    return states_[d].angle ? numbers::wrap(estimate - truth) : estimate - truth;
  }

  const Item& item_;
  std::vector<std::string> header_;
  std::unique_ptr<CatalogueModel> source_;
  std::vector<Quantity> states_;
};

Result judged(const Comparison& asked, double ours) {
  Result result{asked, ours, std::nullopt, !std::isnan(ours)};
  if (const auto* paper = std::get_if<double>(&asked.paper)) result.ratio = ours / *paper;
  if (asked.at_least) result.holds = result.holds && ours >= *asked.at_least;
  if (asked.at_most) result.holds = result.holds && ours <= *asked.at_most;
  return result;
}

}  // namespace

Outcome regenerate(const Item& item) {
  const Laboratory laboratory(item);
  Outcome outcome;
  outcome.states = laboratory.states();
  const Scene one = laboratory.scene(item.simulated.seed);
  outcome.truth = one.truth;
  for (const Run& run : item.runs) outcome.records.emplace_back(run.name, laboratory.filtered(run.name, one, 0));
  for (const Comparison& comparison : item.comparisons)
    outcome.results.push_back(judged(comparison, laboratory.computed(comparison)));
  return outcome;
}

}  // namespace mote::reproduce

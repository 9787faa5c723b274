#include "mote/app/reproduce/laboratory.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/analog/spice.hpp"
#include "mote/app/analog/mixed_run.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/compare/contender.hpp"
#include "mote/app/compare/statistics.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;

/// A wrong word inside an item is a fault of the item's file, not of the command line.
template <class Make>
auto as_bad_data(Make&& make) {
  try {
    return make();
  } catch (const Refusal& refusal) {
    if (refusal.code() != ExitCode::kWrongUse) throw;
    throw Refusal(ExitCode::kBadData, std::string(refusal.what()));
  }
}

bool repeats_one_recording(Kind kind) {
  return kind == Kind::kMeanDifference || kind == Kind::kMeanSpread || kind == Kind::kEvidenceSpread;
}

bool needs_truth(Kind kind) {
  return kind == Kind::kRmse || kind == Kind::kNormalisedError || kind == Kind::kFinalBias;
}

/// Takes "position" for the states x and y together.
bool takes_position(Kind kind) {
  return kind == Kind::kRmse || kind == Kind::kReferenceError || kind == Kind::kRecovered;
}

/// Stands for the posterior where no solver is known, its seed far from those of any repeat.
constexpr std::string_view kLargeRun = "sisr -n 200000";
constexpr std::uint64_t kLargeSeed = std::uint64_t{1} << 32U;

/// Resamplings of one weight vector.
constexpr std::size_t kResamplings = 200;

void refuse_when_stopped() {
  if (stop_flag()) throw Refusal(ExitCode::kInterrupted, "mote reproduce: interrupted; no file was written.");
}

double summary_figure(const Summary& summary, const std::string& key) {
  if (key == "log_evidence") return summary.log_evidence;
  if (key == "mean_ess") return summary.mean_ess;
  if (key == "acceptance") return summary.acceptance;
  if (key == "collapses") return static_cast<double>(summary.collapses);
  if (key == "messages_per_step") return summary.traffic_per_step.messages;
  if (key == "bytes_per_step") return summary.traffic_per_step.bytes;
  return summary.ns_per_particle_step;
}

}  // namespace

Laboratory::Laboratory(Item item) : item_(std::move(item)) {
  if (item_.weights) {
    for (const Run& run : item_.runs) benches_.emplace(run.name, bench_for(run));
    return;
  }
  if (item_.clip) {
    cinema_ = std::make_unique<Cinema>(item_);
    return;
  }
  if (item_.cluster) {
    clusters_ = as_bad_data([&] { return std::make_unique<Clusters>(item_); });
    return;
  }
  if (item_.design) {
    designs_ = as_bad_data([&] { return std::make_unique<Designs>(item_); });
    return;
  }
  if (item_.analog) {
    analogs_ = as_bad_data([&] { return std::make_unique<Analogs>(item_); });
    return;
  }
  const Source& from = item_.recording;
  header_ = from.simulated() ? frame_header(from.columns) : read_table(from.observations).header;
  source_ = model_with(from.settings, from.where);
  states_ = source_->states();
  solver_ = source_->solver();
  for (const Run& run : item_.runs) benches_.emplace(run.name, bench_for(run));
  scene(0);  // reads the data, so that its faults show before the work
  check_figures();
  check_comparisons();
}

std::unique_ptr<CatalogueModel> Laboratory::model_with(const std::vector<std::string>& settings,
                                                       const std::string& where) const {
  return as_bad_data([&] { return find_model(item_.recording.model, where).make(Settings(where, settings), header_); });
}

Laboratory::Bench Laboratory::bench_for(const Run& run) const {
  Bench bench;
  const auto plan = [&] { return plan_from(arguments_from(run.where, plan_options(), run.options)); };
  if (item_.weights) {
    bench.plan = as_bad_data(plan);
    return bench;
  }
  bench.job.model_name = item_.recording.model;
  bench.job.model = model_with(merged(item_.recording.settings, run.settings), run.where);
  if (run.circuit) {
    bench.circuit = as_bad_data([&] { return std::make_shared<CircuitBench>(run, bench.job); });
    return bench;
  }
  if (run.analog) {
    as_bad_data([&] {
      bench.analog = arguments_from(run.where, mixed_run_options(), run.options);
      return bench.plan = plan_from(*bench.analog);
    });
    return bench;
  }
  as_bad_data([&] {
    bench.plan = plan();
    return bench.job.model->filter(bench.plan, run.where);  // refuses what the model does not have
  });
  return bench;
}

std::optional<std::size_t> Laboratory::place_of(const std::string& state) const {
  for (std::size_t d = 0; d < states_.size(); ++d)
    if (states_[d].name == state) return d;
  return std::nullopt;
}

void Laboratory::check_figures() const {
  for (const Figure& figure : item_.figures) {
    const bool plane = figure.state.empty() || (figure.state == "position" && !figure.against.empty());
    if (plane ? place_of("x") && place_of("y") : place_of(figure.state).has_value()) continue;
    throw Refusal(ExitCode::kBadData,
                  {figure.where, "\"state\"", plane ? "a model with x and y" : "a state of the model",
                   figure.state.empty() ? item_.recording.model : "\"" + figure.state + "\"", ""});
  }
}

void Laboratory::check_comparisons() const {
  const Truth& truth = scenes_.at(0).truth;
  const auto known = [&](const std::string& state) {
    const auto d = place_of(state);
    return d && truth.known.size() > *d && truth.known[*d];
  };
  for (const Comparison& c : item_.comparisons) {
    const bool plane =
        (c.state == "position" && takes_position(c.kind)) || (c.state == "bearing" && c.kind == Kind::kRmse);
    const bool position = plane && place_of("x") && place_of("y");
    if (!c.state.empty() && !position && !place_of(c.state))
      throw Refusal(ExitCode::kBadData, {c.where, "\"state\"", "a state of the model", "\"" + c.state + "\"", ""});
    if (needs_truth(c.kind) && !(position ? known("x") && known("y") : known(c.state)))
      throw Refusal(ExitCode::kBadData, {c.where, "\"state\"", "a truth for it", "none", ""});
  }
}

std::string Laboratory::missing() const {
  if (clusters_) return clusters_->missing();
  if (analogs_) return analogs_->missing();
  if (std::any_of(item_.runs.begin(), item_.runs.end(), [](const Run& run) { return run.analog; }))
    if (const std::string why = analog::Spice::missing(); !why.empty()) return why;
  const std::string clip = cinema_ ? cinema_->missing() : "";
  return clip.empty() ? "" : fmt::format("there is no {}. Set MOTE_DATA to the folder with clips/.", clip);
}

std::size_t Laboratory::work() const {
  if (cinema_) return cinema_->work();
  if (clusters_) return clusters_->work();
  if (designs_) return designs_->work();
  if (analogs_) return analogs_->work();
  std::size_t runs = item_.weights ? 0 : item_.runs.size();
  for (const Comparison& c : item_.comparisons)
    runs += (c.kind == Kind::kNormalisedError ? 1 : c.runs.size()) * static_cast<std::size_t>(c.repeats);
  for (const Figure& figure : item_.figures)
    if (!figure.against.empty()) runs += drawn_in(figure).size() * static_cast<std::size_t>(figure.repeats);
  return runs;
}

const Scene& Laboratory::scene(std::uint64_t offset) {
  if (!item_.recording.simulated()) offset = 0;
  const auto [found, fresh] = scenes_.try_emplace(offset);
  if (!fresh) return found->second;
  Scene& scene = found->second;
  const Source& from = item_.recording;
  if (!from.simulated()) {
    scene.recording = recording_from(read_table(from.observations), source_->columns(), from.model);
    if (!from.truth.empty()) scene.truth = truth_from(read_table(from.truth), states_);
    return scene;
  }
  return scene = simulated_scene(*source_, from.steps, from.seed + offset);
}

const RunRecord& Laboratory::record(const std::string& run, std::uint64_t recording_offset, std::uint64_t seed_offset) {
  refuse_when_stopped();
  const auto [found, fresh] = records_.try_emplace({run, recording_offset, seed_offset});
  if (!fresh && !found->second.rows.empty()) return found->second;
  Bench& bench = benches_.at(run);
  bench.job.recording = scene(recording_offset).recording;
  if (bench.circuit) return found->second = bench.circuit->record(bench.job.recording, seed_offset);
  Plan plan = bench.plan;
  plan.seed += seed_offset;
  if (bench.analog) return found->second = mixed_record(bench, plan);
  return found->second = run_job(bench.job, plan, request_for(bench.job, {}, item_.file), item_.file);
}

RunRecord Laboratory::mixed_record(Bench& bench, const Plan& plan) const {
  return as_bad_data([&] {
    if (!bench.design) bench.design = design_from(*bench.analog, *bench.job.model);
    const auto filter = mixed_filter(*bench.job.model, plan, *bench.design, bench.analog->where());
    return run_filter(*filter, bench.job, plan, request_for(bench.job, {}, item_.file));
  });
}

std::vector<double> Laboratory::mean_estimates(const RunRecord& record, std::size_t state) {
  const RunRecord& origin = this->record(item_.runs.front().name, 0, 0);  // angles are measured from it
  std::vector<double> means;
  for (std::size_t k = 0; k < record.rows.size(); ++k) {
    const double mean = record.rows[k].states[state].mean;
    means.push_back(states_[state].angle ? numbers::wrap(mean - origin.rows[k].states[state].mean) : mean);
  }
  return means;
}

/// All runs on one weight vector, so that their times see the same machine.
const std::vector<Resampled>& Laboratory::resamplings(double ess, std::uint64_t repeat) {
  const auto [found, fresh] = resamplings_.try_emplace({ess, repeat});
  if (!fresh) return found->second;
  const WeightedValues set = weighted_values(item_.weights->particles, ess, item_.weights->seed + repeat);
  for (const Run& run : item_.runs)
    found->second.push_back(
        resampled(*benches_.at(run.name).plan.selection.scheme, set, kResamplings, item_.weights->seed + repeat));
  return found->second;
}

double Laboratory::resample_figure(const Comparison& c, std::uint64_t repeat, std::size_t side) {
  refuse_when_stopped();
  std::size_t place = 0;
  while (item_.runs[place].name != c.runs[side]) ++place;
  const Resampled& figure = resamplings(c.ess, repeat)[place];
  ran_();
  if (c.kind == Kind::kResampleError) return figure.error;
  return c.kind == Kind::kResampleTime ? figure.ns : figure.error * figure.ns;
}

std::vector<Tradeoff> Laboratory::tradeoffs() const {
  std::vector<Tradeoff> all;
  for (const double ess : item_.weights->ess)
    for (std::size_t place = 0; place < item_.runs.size(); ++place) {
      std::vector<double> errors;
      std::vector<double> times;
      for (const auto& [level, runs] : resamplings_)
        if (level.first == ess) errors.push_back(runs[place].error), times.push_back(runs[place].ns);
      if (errors.empty()) continue;
      all.push_back({item_.runs[place].name, ess, compare::mean(errors), compare::median(times)});
    }
  return all;
}

std::vector<double> Laboratory::sample(const Comparison& c, std::uint64_t repeat, std::size_t side) {
  if (item_.weights) return {resample_figure(c, repeat, side)};
  if (cinema_) return cinema_->sample(c, repeat, side, ran_);
  if (clusters_) return {clusters_->figure(c, side, ran_)};
  if (designs_) return {designs_->figure(c, side)};
  if (analogs_) return {analogs_->figure(c, side, ran_)};
  if (c.kind == Kind::kCircuit) {
    const double figure = benches_.at(c.runs[side]).circuit->figure(c, scene(0).recording);
    ran_();
    return {figure};
  }
  const bool one_recording = repeats_one_recording(c.kind);
  const std::uint64_t apart = c.kind == Kind::kMeanDifference ? side * static_cast<std::uint64_t>(c.repeats) : 0;
  const RunRecord& run = record(c.runs[side], one_recording ? 0 : repeat, repeat + apart);
  ran_();
  const Truth& truth = scene(one_recording ? 0 : repeat).truth;
  const std::size_t d = place_of(c.state).value_or(0);
  const auto error = [&](const EstimateRow& row) {
    const auto known = truth.states.find(row.t);
    const double e = known == truth.states.end() ? kNaN : row.states[d].mean - known->second[d];
    return states_[d].angle ? numbers::wrap(e) : e;
  };
  switch (c.kind) {
    case Kind::kMeanDifference:
    case Kind::kMeanSpread:
      return mean_estimates(run, d);
    case Kind::kRmse: {
      if (c.state == "bearing") return {bearing_rmse(run, truth, *place_of("x"), *place_of("y"))};
      const Summary summary = summarise(run, &truth);
      if (c.state != "position") return {summary.rmse[d]};
      return {summary.position_error ? summary.position_error->rmse : kNaN};
    }
    case Kind::kNormalisedError: {
      double squares = 0;
      double count = 0;
      const RunRecord& judge = record(c.runs.back(), repeat, repeat);
      for (std::size_t k = 0; k < run.rows.size(); ++k)
        if (const double e = error(run.rows[k]) / judge.rows[k].states[d].sd; !std::isnan(e)) squares += e * e, ++count;
      return {squares / count};
    }
    case Kind::kFinalBias:
      return {error(run.rows.back())};
    case Kind::kReferenceError:
    case Kind::kRecovered:
      return {reference_error(run, repeat, c.state)};
    case Kind::kEvidenceSpread:
      return {summarise(run, nullptr).log_evidence};
    case Kind::kSummary:
      return {summary_figure(summarise(run, nullptr), c.key)};
    case Kind::kResampleError:
    case Kind::kResampleTime:
    case Kind::kResampleCost:
    case Kind::kTrack:
    case Kind::kParticlesEnough:
    case Kind::kCluster:
    case Kind::kCircuit:
    case Kind::kDesign:
    case Kind::kAnalog:
      break;  // of items on weights, clips and clusters, of designs
  }
  return {kNaN};
}

std::vector<std::size_t> Laboratory::places_of(const std::string& state) const {
  if (state == "position") return {*place_of("x"), *place_of("y")};
  return {*place_of(state)};
}

const std::vector<std::vector<double>>& Laboratory::posterior_means(std::uint64_t offset) {
  if (!item_.recording.simulated()) offset = 0;
  const auto [found, fresh] = posterior_means_.try_emplace(offset);
  if (!fresh) return found->second;
  if (solver_)
    if (auto solution = solver_->solve(scene(offset).recording)) return found->second = std::move(solution->means);
  refuse_when_stopped();
  std::vector<std::string> no_notes;
  Job job;
  job.model_name = item_.recording.model;
  job.model = model_with(item_.recording.settings, item_.recording.where);
  job.recording = scene(offset).recording;
  Plan plan = compare::reference_plan(std::string(kLargeRun), item_.file, no_notes);
  plan.seed = kLargeSeed + offset;
  for (const EstimateRow& row : run_job(job, plan, request_for(job, {}, item_.file), item_.file).rows) {
    auto& means = found->second.emplace_back();
    for (const Moments& m : row.states) means.push_back(m.mean);
  }
  return found->second;
}

double Laboratory::reference_error(const RunRecord& record, std::uint64_t offset, const std::string& state) {
  const auto& means = posterior_means(offset);
  double squares = 0;
  for (std::size_t k = 0; k < record.rows.size(); ++k)
    for (const std::size_t d : places_of(state)) {
      const double e = record.rows[k].states[d].mean - means[k][d];
      squares += std::pow(states_[d].angle ? numbers::wrap(e) : e, 2);
    }
  return squares / static_cast<double>(record.rows.size());
}

std::vector<const Run*> Laboratory::drawn_in(const Figure& figure) const {
  std::vector<const Run*> drawn;
  const auto named = [&](const std::string& name) {
    return std::find(figure.runs.begin(), figure.runs.end(), name) != figure.runs.end();
  };
  for (const Run& run : item_.runs)
    if (figure.runs.empty() || named(run.name) || named(run.series)) drawn.push_back(&run);
  return drawn;
}

std::vector<ErrorRow> Laboratory::errors_of(const Figure& figure) {
  std::vector<ErrorRow> rows;
  for (const Run* run : drawn_in(figure))
    rows.push_back({.run = run->name, .series = run->series, .number = run->number});
  std::vector<std::vector<double>> errors(rows.size());
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(figure.repeats); ++r)
    for (std::size_t i = 0; i < rows.size(); ++i) try {
        ran_();
        const RunRecord& record = this->record(rows[i].run, r, r);
        errors[i].push_back(reference_error(record, r, figure.state));
        const Traffic traffic = summarise(record, nullptr).traffic_per_step;
        rows[i].messages += traffic.messages;
        rows[i].bytes += traffic.bytes;
      } catch (const Refusal& refusal) {
        if (refusal.code() != ExitCode::kCollapsed) throw;
        errors[i].push_back(kInfinity);
      }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].messages /= figure.repeats;
    rows[i].bytes /= figure.repeats;
    rows[i].error = compare::median(errors[i]);
    rows[i].interval = compare::bootstrap({errors[i].size(), 1}, [&](std::span<const std::size_t> places) {
      std::vector<double> drawn;
      for (const std::size_t r : places) drawn.push_back(errors[i][r]);
      return compare::median(std::move(drawn));
    });
  }
  return rows;
}

Samples Laboratory::samples_of(const Comparison& c) {
  Samples samples;
  samples.values.resize(c.kind == Kind::kNormalisedError ? 1 : c.runs.size());
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(c.repeats); ++r)  // outside, so that times are paired
    for (std::size_t side = 0; side < samples.values.size(); ++side) samples.values[side].push_back(sample(c, r, side));
  if (c.kind == Kind::kParticlesEnough)
    for (const std::string& series : c.runs) samples.particles.push_back(cinema_->particles_of(series));
  if (c.kind != Kind::kMeanDifference || c.unit != Comparison::Unit::kPosteriorSd) return samples;
  const std::size_t d = *place_of(c.state);
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(c.repeats); ++r) {
    auto& sds = samples.sds.emplace_back();
    for (const EstimateRow& row : record(c.runs[1], 0, r + static_cast<std::uint64_t>(c.repeats)).rows)
      sds.push_back(row.states[d].sd);
  }
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
  outcome.states = states_;
  outcome.truth = scene(0).truth;
  for (const ObservedStep& step : scene(0).recording.steps) outcome.times.push_back(step.t);
  for (const Run& run : item_.runs) try {
      ran_();
      outcome.records.emplace_back(run.name, record(run.name, 0, 0));
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

/// The golden model of a circuit goes on without the tools that simulate and synthesise.
std::string Laboratory::missing_tool(const Comparison& c) const {
  if (c.kind != Kind::kCircuit) return "";
  for (const std::string& run : c.runs)
    if (std::string tool = benches_.at(run).circuit->missing(c); !tool.empty()) return tool;
  return "";
}

Outcome Laboratory::regenerate(const std::function<void()>& ran) {
  ran_ = ran;
  Outcome outcome;
  if (!item_.weights && !cinema_ && !clusters_ && !designs_ && !analogs_) run_filters(outcome);
  for (const Comparison& comparison : item_.comparisons)
    if (const std::string tool = missing_tool(comparison); !tool.empty()) {
      outcome.left_out.push_back(fmt::format("left out {}: {}", comparison.name, tool));
    } else {
      outcome.results.push_back(judged(comparison));
    }
  for (const Figure& figure : item_.figures)
    if (!figure.against.empty()) outcome.errors[figure.title] = errors_of(figure);
  if (item_.weights) outcome.tradeoffs = tradeoffs();
  if (cinema_) show_clips(outcome);
  if (clusters_) outcome.sweeps = clusters_->sweeps(ran_);
  if (designs_)
    for (const Figure& figure : item_.figures) outcome.curves[figure.title] = designs_->curves(figure);
  if (analogs_)
    for (const Figure& figure : item_.figures) outcome.drawn[figure.title] = analogs_->chart(figure, ran_);
  return outcome;
}

}  // namespace mote::reproduce

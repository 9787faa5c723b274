#include "mote/app/reproduce/filters.hpp"

#include <algorithm>
#include <cmath>

#include "mote/app/compare/contender.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;

bool repeats_one_recording(Kind kind) {
  return kind == Kind::kMeanDifference || kind == Kind::kMeanSpread || kind == Kind::kEvidenceSpread;
}

bool needs_truth(Kind kind) {
  return kind == Kind::kRmse || kind == Kind::kNormalisedError || kind == Kind::kFinalBias;
}

/// Whether a word stands for the states x and y together: their place, or their direction from the origin.
bool is_plane(const std::string& state) { return state == "position" || state == "bearing"; }
bool takes_plane(Kind kind) { return kind == Kind::kRmse || kind == Kind::kReferenceError || kind == Kind::kRecovered; }

/// Stands for the posterior where no solver is known, its seed far from those of any repeat.
constexpr std::string_view kLargeRun = "sisr -n 200000";
constexpr std::uint64_t kLargeSeed = std::uint64_t{1} << 32U;

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

Filters::Filters(const Item& item) : runs_(item), solver_(runs_.model().solver()) {
  runs_.scene(0);  // reads the data, so that its faults show before the work
  check_figures();
  check_comparisons();
}

void Filters::check_figures() const {
  for (const Figure& figure : runs_.item().figures) {
    const bool plane = figure.state.empty() || (is_plane(figure.state) && !figure.against.empty());
    if (plane ? runs_.place_of("x") && runs_.place_of("y") : runs_.place_of(figure.state).has_value()) continue;
    throw Refusal(ExitCode::kBadData,
                  {figure.where, "\"state\"", plane ? "a model with x and y" : "a state of the model",
                   figure.state.empty() ? runs_.item().recording.model : "\"" + figure.state + "\"", ""});
  }
}

void Filters::check_comparisons() {
  const Truth& truth = runs_.scene(0).truth;
  const auto known = [&](const std::string& state) {
    const auto d = runs_.place_of(state);
    return d && truth.known.size() > *d && truth.known[*d];
  };
  for (const Comparison& c : runs_.item().comparisons) {
    const bool plane =
        is_plane(c.state) && takes_plane(c.kind) && runs_.place_of("x").has_value() && runs_.place_of("y").has_value();
    if (!c.state.empty() && !plane && !runs_.place_of(c.state))
      throw Refusal(ExitCode::kBadData, {c.where, "\"state\"", "a state of the model", "\"" + c.state + "\"", ""});
    if (needs_truth(c.kind) && !(plane ? known("x") && known("y") : known(c.state)))
      throw Refusal(ExitCode::kBadData, {c.where, "\"state\"", "a truth for it", "none", ""});
  }
}

std::size_t Filters::work() const {
  const Item& item = runs_.item();
  std::size_t runs = item.runs.size();
  for (const Comparison& c : item.comparisons)
    runs += (c.kind == Kind::kNormalisedError ? 1 : c.runs.size()) * static_cast<std::size_t>(c.repeats);
  for (const Figure& figure : item.figures)
    if (!figure.against.empty()) runs += drawn_in(figure).size() * static_cast<std::size_t>(figure.repeats);
  return runs;
}

std::string Filters::missing_tool(const Comparison& c) {
  if (c.kind != Kind::kCircuit) return "";
  for (const std::string& run : c.runs)
    if (std::string tool = runs_.circuit(run).missing(c); !tool.empty()) return tool;
  return "";
}

std::vector<std::function<void()>> Filters::errands() {
  std::map<std::string, Tools> needed;
  for (const Comparison& c : runs_.item().comparisons)
    if (c.kind == Kind::kCircuit && missing_tool(c).empty())
      for (const std::string& run : c.runs) {
        const Tools tools = runs_.circuit(run).needed(c);
        Tools& all = needed[run];
        all = {all.simulation || tools.simulation, all.synthesis || tools.synthesis, all.sta || tools.sta};
      }
  std::vector<std::function<void()>> all;
  for (const auto& [run, tools] : needed)
    for (auto& errand : runs_.circuit(run).errands(tools, runs_.scene(0).recording)) all.push_back(std::move(errand));
  return all;
}

std::vector<double> Filters::mean_estimates(const RunRecord& record, std::size_t state) {
  const RunRecord& origin = runs_.record(runs_.item().runs.front().name, 0, 0);  // angles are measured from it
  std::vector<double> means;
  for (std::size_t k = 0; k < record.rows.size(); ++k) {
    const double mean = record.rows[k].states[state].mean;
    means.push_back(runs_.states()[state].angle ? numbers::wrap(mean - origin.rows[k].states[state].mean) : mean);
  }
  return means;
}

std::vector<double> Filters::sample(const Comparison& c, std::uint64_t repeat, std::size_t side,
                                    const std::function<void()>& ran) {
  if (c.kind == Kind::kCircuit) {
    const double figure = runs_.circuit(c.runs[side]).figure(c, runs_.scene(0).recording);
    ran();
    return {figure};
  }
  const std::uint64_t offset = repeats_one_recording(c.kind) ? 0 : repeat;
  const std::uint64_t apart = c.kind == Kind::kMeanDifference ? side * static_cast<std::uint64_t>(c.repeats) : 0;
  const RunRecord& run = runs_.record(c.runs[side], offset, repeat + apart);
  ran();
  switch (c.kind) {
    case Kind::kMeanDifference:
    case Kind::kMeanSpread:
      return mean_estimates(run, runs_.place_of(c.state).value_or(0));
    case Kind::kRmse:
    case Kind::kFinalBias:
      return {truth_figure(c, run, runs_.scene(offset).truth)};
    case Kind::kNormalisedError:
      return {normalised_error(c, run, repeat)};
    case Kind::kReferenceError:
    case Kind::kRecovered:
      return {reference_error(run, repeat, c.state)};
    case Kind::kEvidenceSpread:
      return {summarise(run, nullptr).log_evidence};
    case Kind::kSummary:
      return {summary_figure(summarise(run, nullptr), c.key)};
    default:
      return {kNaN};  // of items on weights, clips and clusters, of designs
  }
}

double Filters::error(const EstimateRow& row, const Truth& truth, std::size_t d) const {
  const auto known = truth.states.find(row.t);
  const double e = known == truth.states.end() ? kNaN : row.states[d].mean - known->second[d];
  return runs_.states()[d].angle ? numbers::wrap(e) : e;
}

double Filters::truth_figure(const Comparison& c, const RunRecord& run, const Truth& truth) const {
  if (c.state == "bearing") return bearing_rmse(run, truth, *runs_.place_of("x"), *runs_.place_of("y"));
  const std::size_t d = runs_.place_of(c.state).value_or(0);
  if (c.kind == Kind::kFinalBias) return error(run.rows.back(), truth, d);
  const Summary summary = summarise(run, &truth);
  if (c.state != "position") return summary.rmse[d];
  return summary.position_error ? summary.position_error->rmse : kNaN;
}

double Filters::normalised_error(const Comparison& c, const RunRecord& run, std::uint64_t repeat) {
  const Truth& truth = runs_.scene(repeat).truth;
  const RunRecord& judge = runs_.record(c.runs.back(), repeat, repeat);
  const std::size_t d = runs_.place_of(c.state).value_or(0);
  double squares = 0;
  double count = 0;
  for (std::size_t k = 0; k < run.rows.size(); ++k)
    if (const double e = error(run.rows[k], truth, d) / judge.rows[k].states[d].sd; !std::isnan(e))
      squares += e * e, ++count;
  return squares / count;
}

std::vector<std::vector<double>> Filters::posterior_sds(const Comparison& c) {
  const std::size_t d = *runs_.place_of(c.state);
  std::vector<std::vector<double>> all;
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(c.repeats); ++r) {
    auto& sds = all.emplace_back();
    for (const EstimateRow& row : runs_.record(c.runs[1], 0, r + static_cast<std::uint64_t>(c.repeats)).rows)
      sds.push_back(row.states[d].sd);
  }
  return all;
}

const std::vector<std::vector<double>>& Filters::posterior_means(std::uint64_t offset) {
  if (!runs_.item().recording.simulated()) offset = 0;
  const auto [found, fresh] = posterior_means_.try_emplace(offset);
  if (!fresh) return found->second;
  if (solver_)
    if (auto solution = solver_->solve(runs_.scene(offset).recording))
      return found->second = std::move(solution->means);
  std::vector<std::string> no_notes;
  Plan plan = compare::reference_plan(std::string(kLargeRun), runs_.item().file, no_notes);
  plan.seed = kLargeSeed + offset;
  for (const EstimateRow& row : runs_.record(plan, offset).rows) {
    auto& means = found->second.emplace_back();
    for (const Moments& m : row.states) means.push_back(m.mean);
  }
  return found->second;
}

double Filters::reference_error(const RunRecord& record, std::uint64_t offset, const std::string& state) {
  const auto& means = posterior_means(offset);
  const std::size_t x = runs_.place_of(is_plane(state) ? "x" : state).value();
  const std::size_t y = is_plane(state) ? runs_.place_of("y").value() : x;
  double squares = 0;
  for (std::size_t k = 0; k < record.rows.size(); ++k) {
    const auto& found = record.rows[k].states;
    const auto of = [&](std::size_t d) {
      const double e = found[d].mean - means[k][d];
      return std::pow(runs_.states()[d].angle ? numbers::wrap(e) : e, 2);
    };
    if (state == "bearing") {
      const double e = std::atan2(found[y].mean, found[x].mean) - std::atan2(means[k][y], means[k][x]);
      squares += std::pow(numbers::wrap(e), 2);
    } else {
      squares += of(x) + (y == x ? 0 : of(y));
    }
  }
  return squares / static_cast<double>(record.rows.size());
}

std::vector<const Run*> Filters::drawn_in(const Figure& figure) const {
  std::vector<const Run*> drawn;
  const auto named = [&](const std::string& name) {
    return std::find(figure.runs.begin(), figure.runs.end(), name) != figure.runs.end();
  };
  for (const Run& run : runs_.item().runs)
    if (figure.runs.empty() || named(run.name) || named(run.series)) drawn.push_back(&run);
  return drawn;
}

std::vector<ErrorRow> Filters::errors_of(const Figure& figure, const std::function<void()>& ran) {
  std::vector<ErrorRow> rows;
  for (const Run* run : drawn_in(figure))
    rows.push_back({.run = run->name, .series = run->series, .number = run->number});
  std::vector<std::vector<double>> errors(rows.size());
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(figure.repeats); ++r)
    for (std::size_t i = 0; i < rows.size(); ++i) try {
        ran();
        const RunRecord& record = runs_.record(rows[i].run, r, r);
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

}  // namespace mote::reproduce

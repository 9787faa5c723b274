#include "mote/app/reproduce/figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "mote/app/compare/statistics.hpp"
#include "mote/app/files/output.hpp"

namespace mote::reproduce {
namespace {

using report::Chart;
using report::Series;

std::size_t place_of(const Outcome& outcome, const std::string& name) {
  std::size_t d = 0;
  while (outcome.states[d].name != name) ++d;
  return d;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " (" + unit + ")";
}

/// The true state at a time; NaN where it is not known.
double truth_at(const Outcome& outcome, Step t, std::size_t d) {
  const auto found = outcome.truth.states.find(t);
  return found == outcome.truth.states.end() ? kNaN : found->second[d];
}

bool has_truth(const Outcome& outcome, std::size_t d) {
  return outcome.truth.known.size() > d && outcome.truth.known[d];
}

void add(Series& series, double x, double y, bool angle = false) {
  if (angle && !series.y.empty() && std::abs(y - series.y.back()) > kPi) {
    series.x.push_back(x);
    series.y.push_back(kNaN);
  }
  series.x.push_back(x);
  series.y.push_back(y);
}

bool draws(const Figure& figure, const std::string& run) {
  return figure.runs.empty() || std::find(figure.runs.begin(), figure.runs.end(), run) != figure.runs.end();
}

void draw_track(Chart& chart, const Figure& figure, const Outcome& outcome) {
  const std::size_t ix = place_of(outcome, "x");
  const std::size_t iy = place_of(outcome, "y");
  chart.x_label = with_unit("x", outcome.states[ix].unit);
  chart.y_label = with_unit("y", outcome.states[iy].unit);
  chart.equal_axes = true;
  for (const auto& [name, record] : outcome.records) {
    if (!draws(figure, name)) continue;
    Series& series = chart.series.emplace_back(Series{.name = name});
    for (const EstimateRow& row : record.rows) add(series, row.states[ix].mean, row.states[iy].mean);
  }
  if (!has_truth(outcome, ix) || !has_truth(outcome, iy)) return;
  Series& truth = chart.series.emplace_back(Series{.name = "truth"});
  for (const Step t : outcome.times) add(truth, truth_at(outcome, t, ix), truth_at(outcome, t, iy));
}

void draw_over_time(Chart& chart, const Figure& figure, const Outcome& outcome) {
  const std::size_t d = place_of(outcome, figure.state);
  const Quantity& state = outcome.states[d];
  chart.x_label = "t";
  chart.y_label = with_unit(figure.error ? "|error of " + state.name + "|" : state.name, state.unit);
  for (const auto& [name, record] : outcome.records) {
    if (!draws(figure, name)) continue;
    Series& series = chart.series.emplace_back(Series{.name = name});
    for (const EstimateRow& row : record.rows) {
      const double error = row.states[d].mean - truth_at(outcome, row.t, d);
      if (figure.error) add(series, row.t, std::abs(state.angle ? numbers::wrap(error) : error));
      if (!figure.error) add(series, row.t, row.states[d].mean, state.angle);
    }
  }
  if (figure.error || !has_truth(outcome, d)) return;
  Series& truth = chart.series.emplace_back(Series{.name = "truth"});
  for (const Step t : outcome.times) add(truth, t, truth_at(outcome, t, d), state.angle);
}

/// Error against time at one level of ESS, a point for each run.
void draw_tradeoff(Chart& chart, const Figure& figure, const Outcome& outcome) {
  chart.x_label = "ns a draw";
  chart.y_label = "error (multinomial variances)";
  chart.log_x = chart.log_y = true;
  for (const Tradeoff& t : outcome.tradeoffs)
    if (t.ess == figure.ess && draws(figure, t.run))
      chart.series.push_back({.name = t.run, .mark = Series::Mark::kPoints, .x = {t.ns}, .y = {t.error}});
}

/// Centre error over the number of particles, a mean over repeats, a line for each series.
void draw_sweep(Chart& chart, const Figure& figure, const Outcome& outcome) {
  chart.x_label = "particles";
  chart.y_label = "centre error (px)";
  chart.log_x = chart.log_y = true;
  std::map<std::string, std::map<int, std::vector<double>>> sweeps;
  for (const TrackRow& row : outcome.tracks)
    if (!row.series.empty() && draws(figure, row.series))
      sweeps[row.series][row.particles].push_back(row.figures.find("centre_error_px")->second);
  for (const auto& [name, sweep] : sweeps) {
    Series& series = chart.series.emplace_back(Series{.name = name, .mark = Series::Mark::kMarkedLine});
    for (const auto& [particles, errors] : sweep) add(series, particles, compare::mean(errors));
  }
}

/// The name of what an error is drawn against.
std::string against_text(const Item& item, const std::vector<ErrorRow>& rows, const std::string& against) {
  if (against == "bytes_per_step") return "bytes a step between groups (none: a line across)";
  if (against == "messages_per_step") return "messages a step between groups (none: a line across)";
  for (const Run& run : item.runs)
    if (!run.sweep.empty() && std::any_of(rows.begin(), rows.end(), [&](auto& row) { return row.run == run.name; }))
      return run.sweep;
  return against;
}

/// Median error to the posterior mean, a line for each series, a point for each other run; what has no place on the
/// logarithmic axis is a line across.
void draw_errors(Chart& chart, const Item& item, const Figure& figure, const Outcome& outcome) {
  const std::vector<ErrorRow>& rows = outcome.errors.at(figure.title);
  chart.x_label = against_text(item, rows, figure.against);
  chart.y_label = "median MSE of " + figure.state + " to the posterior mean";
  chart.log_x = chart.log_y = true;
  const auto place = [&](const ErrorRow& row) {
    if (figure.against == "number") return static_cast<double>(row.number);
    return figure.against == "bytes_per_step" ? row.bytes : row.messages;
  };
  double least = kInfinity;
  double most = 0;
  for (const ErrorRow& row : rows)
    if (place(row) > 0) least = std::min(least, place(row)), most = std::max(most, place(row));
  for (const ErrorRow& row : rows) {
    const std::string& name = row.series.empty() ? row.run : row.series;
    if (chart.series.empty() || chart.series.back().name != name)
      chart.series.push_back(
          {.name = name, .mark = row.series.empty() ? Series::Mark::kPoints : Series::Mark::kMarkedLine});
    Series& series = chart.series.back();
    if (place(row) > 0) {
      add(series, place(row), row.error);
    } else if (row.series.empty() && most > 0) {
      series.mark = Series::Mark::kLine;
      for (const double x : {least, most}) add(series, x, row.error);
    }
  }
}

std::string errors_csv(const Outcome& outcome) {
  std::string csv = "figure,run,number,median_mse,low,high,messages_per_step,bytes_per_step\n";
  for (const auto& [title, rows] : outcome.errors)
    for (const ErrorRow& row : rows) {
      csv += slug(title) + "," + slug(row.run) + "," + std::to_string(row.number);
      for (const double value : {row.error, row.interval.low, row.interval.high, row.messages, row.bytes})
        csv += "," + exact(value);
      csv += '\n';
    }
  return csv;
}

/// Time or speed-up along the stage whose ranks are varied, a line for each run.
void draw_clusters(Chart& chart, const Figure& figure, const Outcome& outcome) {
  bool weighers = false;
  for (const auto& [name, sweep] : outcome.sweeps) weighers = weighers || sweep.weighers.size() > 1;
  chart.x_label = weighers ? "weighers R_w" : "proposers R_p";
  chart.y_label = figure.quantity == "speedup" ? "times the first setting" : "s";
  for (const auto& [name, sweep] : outcome.sweeps) {
    if (!draws(figure, name)) continue;
    Series& series = chart.series.emplace_back(Series{.name = name, .mark = Series::Mark::kMarkedLine});
    for (const simulated::SweepRun& run : sweep.runs)
      add(series, static_cast<double>(weighers ? run.cast.weighers : run.cast.proposers),
          figure.quantity == "speedup" ? run.speedup : run.seconds_per_step * static_cast<double>(sweep.work.steps));
  }
}

/// Time along a number of blocks: a law and the exact schedule for each run.
void draw_designs(Chart& chart, const Figure& figure, const Outcome& outcome) {
  chart.x_label = figure.quantity == kDesignFigures[0] ? "pairs R" : "weighers R_w";
  chart.y_label = "time of a step";
  for (const DesignCurve& curve : outcome.curves.at(figure.title)) {
    chart.series.push_back(
        {.name = curve.run + ", law", .mark = Series::Mark::kMarkedLine, .x = curve.blocks, .y = curve.law});
    chart.series.push_back(
        {.name = curve.run + ", exact", .mark = Series::Mark::kPoints, .x = curve.blocks, .y = curve.exact});
  }
}

std::string curves_csv(const Outcome& outcome) {
  std::string csv = "figure,run,blocks,law,exact\n";
  for (const auto& [title, curves] : outcome.curves)
    for (const DesignCurve& curve : curves)
      for (std::size_t i = 0; i < curve.blocks.size(); ++i)
        csv += fmt::format("{},{},{},{},{}\n", slug(title), slug(curve.run), curve.blocks[i], exact(curve.law[i]),
                           exact(curve.exact[i]));
  return csv;
}

std::string drawn_csv(const Outcome& outcome) {
  std::string csv = "figure,series,x,y\n";
  for (const auto& [title, chart] : outcome.drawn)
    for (const Series& series : chart.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        csv += fmt::format("{},{},{},{}\n", slug(title), slug(series.name), exact(series.x[i]), exact(series.y[i]));
  return csv;
}

std::string sweeps_csv(const Outcome& outcome) {
  std::string csv = "run,proposers,weighers,chains,seconds_per_step,law_seconds,speedup\n";
  for (const auto& [name, sweep] : outcome.sweeps)
    for (const simulated::SweepRun& run : sweep.runs)
      csv += fmt::format("{},{},{},{},{},{},{}\n", slug(name), run.cast.proposers, run.cast.weighers, run.cast.chains,
                         exact(run.seconds_per_step), exact(run.law_seconds), exact(run.speedup));
  return csv;
}

std::string tracks_csv(const Outcome& outcome) {
  std::string csv = "run,particles,repeat";
  for (const std::string_view key : kTrackKeys) csv += "," + std::string(key);
  csv += '\n';
  for (const TrackRow& row : outcome.tracks) {
    csv += slug(row.run) + "," + std::to_string(row.particles) + "," + std::to_string(row.repeat);
    for (const std::string_view key : kTrackKeys) csv += "," + exact(row.figures.find(key)->second);
    csv += '\n';
  }
  return csv;
}

std::string tradeoff_csv(const Outcome& outcome) {
  std::string csv = "run,ess,error,ns_per_draw\n";
  for (const Tradeoff& t : outcome.tradeoffs)
    csv += slug(t.run) + "," + exact(t.ess) + "," + exact(t.error) + "," + exact(t.ns) + "\n";
  return csv;
}

}  // namespace

Chart chart_of(const Item& item, const Figure& figure, const Outcome& outcome) {
  Chart chart{.title = item.paper + " " + item.name + ": " + figure.title};
  if (item.weights) {
    draw_tradeoff(chart, figure, outcome);
  } else if (item.clip) {
    draw_sweep(chart, figure, outcome);
  } else if (!figure.against.empty()) {
    draw_errors(chart, item, figure, outcome);
  } else if (item.cluster) {
    draw_clusters(chart, figure, outcome);
  } else if (item.design) {
    draw_designs(chart, figure, outcome);
  } else if (item.analog) {
    const std::string title = chart.title;
    chart = outcome.drawn.at(figure.title);
    chart.title = title;
  } else if (figure.state.empty()) {
    draw_track(chart, figure, outcome);
  } else {
    draw_over_time(chart, figure, outcome);
  }
  return chart;
}

std::string figure_csv(const Outcome& outcome) {
  if (!outcome.tradeoffs.empty()) return tradeoff_csv(outcome);
  if (!outcome.tracks.empty()) return tracks_csv(outcome);
  if (!outcome.errors.empty()) return errors_csv(outcome);
  if (!outcome.sweeps.empty()) return sweeps_csv(outcome);
  if (!outcome.curves.empty()) return curves_csv(outcome);
  if (!outcome.drawn.empty()) return drawn_csv(outcome);
  std::string csv = "t";
  for (const Quantity& state : outcome.states) csv += ",truth_" + state.name;
  for (const auto& [name, record] : outcome.records)
    for (const Quantity& state : outcome.states)
      for (const char* moment : {"_mean", "_sd"}) csv += "," + slug(name) + "_" + state.name + moment;
  csv += '\n';
  for (std::size_t k = 0; k < outcome.times.size(); ++k) {
    csv += std::to_string(outcome.times[k]);
    for (std::size_t d = 0; d < outcome.states.size(); ++d) csv += "," + exact(truth_at(outcome, outcome.times[k], d));
    for (const auto& [name, record] : outcome.records)
      for (const Moments& m : record.rows[k].states) csv += "," + exact(m.mean) + "," + exact(m.sd);
    csv += '\n';
  }
  return csv;
}

}  // namespace mote::reproduce

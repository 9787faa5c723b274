#include "mote/report/run_page.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mote::report {
namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

/// A series over time, built row by row; an angle that jumps by more than half a turn breaks the line.
class Curve {
 public:
  Curve(std::string name, Series::Mark mark, bool angle = false)
      : series_{.name = std::move(name), .mark = mark}, angle_(angle) {}
  void add(double x, double y) {
    if (angle_ && series_.mark == Series::Mark::kLine && !series_.y.empty() && std::abs(y - series_.y.back()) > kPi)
      push(x, kNaN);
    push(x, y);
  }
  Series take() { return std::move(series_); }

 private:
  void push(double x, double y) {
    series_.x.push_back(x);
    series_.y.push_back(y);
  }
  Series series_;
  bool angle_;
};

/// All seen measurements of one observation column.
Series measurements(const Recording& recording, std::size_t column, const std::string& name) {
  Curve curve(name, Series::Mark::kPoints);
  for (const ObservedStep& step : recording.steps)
    for (const auto& row : step.rows)
      if (row.seen(column)) curve.add(step.t, row[column]);
  return curve.take();
}

Chart state_chart(const RunRecord& record, std::size_t d, const Recording& recording, const Truth* truth) {
  const Quantity& state = record.states[d];
  Chart chart{.title = state.name, .x_label = "t", .y_label = with_unit(state.name, state.unit)};
  Band band{.name = "estimate ± 2 sd"};
  Curve estimate("estimate", Series::Mark::kLine, state.angle);
  Curve known("truth", Series::Mark::kLine, state.angle);
  for (const EstimateRow& row : record.rows) {
    const Moments& m = row.states[d];
    band.x.push_back(row.t);
    band.low.push_back(m.mean - 2 * m.sd);
    band.high.push_back(m.mean + 2 * m.sd);
    estimate.add(row.t, m.mean);
  }
  chart.bands.push_back(std::move(band));
  for (std::size_t j = 0; j < recording.observations.size(); ++j)
    if (recording.observations[j].state == state.name)
      chart.series.push_back(measurements(recording, j, recording.observations[j].name));
  chart.series.push_back(estimate.take());
  if (truth != nullptr && truth->known[d]) {
    for (const auto& [t, x] : truth->states) known.add(t, x[d]);
    chart.series.push_back(known.take());
  }
  return chart;
}

/// The places of the states x and y, if the model has both.
bool find_plane(const std::vector<Quantity>& states, std::size_t& ix, std::size_t& iy) {
  bool have_x = false;
  bool have_y = false;
  for (std::size_t d = 0; d < states.size(); ++d) {
    if (states[d].name == "x") ix = d, have_x = true;
    if (states[d].name == "y") iy = d, have_y = true;
  }
  return have_x && have_y;
}

Chart track_chart(const RunRecord& record, std::size_t ix, std::size_t iy, const Truth* truth) {
  Chart chart{.title = "Track",
              .x_label = with_unit("x", record.states[ix].unit),
              .y_label = with_unit("y", record.states[iy].unit),
              .equal_axes = true};
  Curve estimate("estimate", Series::Mark::kLine);
  for (const EstimateRow& row : record.rows) estimate.add(row.states[ix].mean, row.states[iy].mean);
  chart.series.push_back(estimate.take());
  if (truth != nullptr && truth->known[ix] && truth->known[iy]) {
    Curve known("truth", Series::Mark::kLine);
    for (const auto& [t, x] : truth->states) known.add(x[ix], x[iy]);
    chart.series.push_back(known.take());
  }
  return chart;
}

template <class Value>
Chart over_time(const RunRecord& record, const std::string& title, const std::string& label, Series::Mark mark,
                Value&& value) {
  Chart chart{.title = title, .x_label = "t", .y_label = label};
  Curve curve(title, mark);
  for (const EstimateRow& row : record.rows) curve.add(row.t, value(row));
  chart.series.push_back(curve.take());
  return chart;
}

std::vector<Chart> charts_of(const RunRecord& record, const Summary& summary, const Recording& recording,
                             const Truth* truth) {
  std::vector<Chart> charts;
  std::size_t ix = 0;
  std::size_t iy = 0;
  if (find_plane(record.states, ix, iy)) charts.push_back(track_chart(record, ix, iy, truth));
  for (std::size_t d = 0; d < record.states.size(); ++d) charts.push_back(state_chart(record, d, recording, truth));
  for (std::size_t j = 0; j < recording.observations.size(); ++j) {
    const Column& column = recording.observations[j];
    if (!column.state.empty()) continue;
    charts.push_back({.title = "Observation " + column.name,
                      .x_label = "t",
                      .y_label = with_unit(column.name, column.unit),
                      .series = {measurements(recording, j, column.name)}});
  }
  for (std::size_t f = 0; f < record.function_labels.size(); ++f)
    charts.push_back(over_time(record, record.function_labels[f], record.function_labels[f], Series::Mark::kLine,
                               [f](const EstimateRow& row) { return row.functions[f]; }));
  charts.push_back(over_time(record, "Effective sample size", "particles", Series::Mark::kLine,
                             [](const EstimateRow& row) { return row.report.ess; }));
  if (!std::isnan(summary.acceptance))
    charts.push_back(over_time(record, "Acceptance", "accepted / offered", Series::Mark::kLine,
                               [](const EstimateRow& row) { return row.report.acceptance; }));
  charts.push_back(over_time(record, "Log evidence of each step", "nat", Series::Mark::kPoints,
                             [](const EstimateRow& row) { return row.report.log_evidence; }));
  if (record.stages && !record.stages->timeline.empty())
    charts.push_back(stage_chart(
        *record.stages, fmt::format("Stages at work, t = {}", fmt::join(record.stages->timeline_steps, ", "))));
  return charts;
}

std::vector<Fact> facts_of(const RunRecord& record, const Summary& summary, const std::string& source) {
  std::vector<Fact> facts{
      {"Model", record.model},
      {"Data", source},
      {"Filter", std::string(name_of(record.plan.filter))},
      {"Engine", record.engine},
      {"Particles", std::to_string(record.plan.particles)},
      {"Seed", std::to_string(record.plan.seed)},
      {"Steps estimated / predicted", fmt::format("{} / {}", record.rows.size(), record.predicted_steps)},
      {"Log evidence", fmt::format("{:.6g} nat", summary.log_evidence)},
      {"Mean ESS", fmt::format("{:.4g}", summary.mean_ess)},
      {"Time per particle and step", fmt::format("{:.3g} ns", summary.ns_per_particle_step)}};
  if (record.plan.filter == FilterKind::kSisr || record.plan.filter == FilterKind::kDistributed)
    facts.push_back({"Resampler", std::string(record.plan.selection.scheme->name)});
  if (record.plan.proposal != "prior") facts.push_back({"Proposal", record.plan.proposal});
  if (!std::isnan(summary.acceptance)) facts.push_back({"Acceptance", fmt::format("{:.3f}", summary.acceptance)});
  if (!std::isnan(summary.mean_burn_in)) facts.push_back({"Mean burn-in", fmt::format("{:.1f}", summary.mean_burn_in)});
  facts.push_back({"Collapses", std::to_string(summary.collapses)});
  return facts;
}

Table stage_table(const StageRecord& record) {
  Table table{.title = "Stages",
              .columns = {"Worker", "Blocks", "Busy (s)", "Idle (s)", "Busy", "Mean queue", "Largest queue"}};
  for (const StageUse& stage : record.stages)
    for (std::size_t k = 0; k < stage.workers.size(); ++k) {
      const StageWorker& worker = stage.workers[k];
      table.rows.push_back(
          {fmt::format("{} {}", stage.name, k + 1), std::to_string(worker.blocks),
           fmt::format("{:.3g}", worker.busy_seconds), fmt::format("{:.3g}", record.seconds - worker.busy_seconds),
           fmt::format("{:.0f} %", 100 * worker.busy_seconds / record.seconds),
           k == 0 ? fmt::format("{:.1f}", stage.mean_queue) : "", k == 0 ? std::to_string(stage.largest_queue) : ""});
    }
  return table;
}

Table error_table(const RunRecord& record, const Summary& summary) {
  Table errors{.title = "Error against the truth", .columns = {"Quantity", "RMSE", "Mean", "Median", "Unit"}};
  for (std::size_t d = 0; d < summary.rmse.size(); ++d)
    if (!std::isnan(summary.rmse[d]))
      errors.rows.push_back(
          {record.states[d].name, fmt::format("{:.4g}", summary.rmse[d]), "", "", record.states[d].unit});
  if (const auto& p = summary.position_error)
    errors.rows.push_back({"position", fmt::format("{:.4g}", p->rmse), fmt::format("{:.4g}", p->mean),
                           fmt::format("{:.4g}", p->median), "m"});
  return errors;
}

std::vector<Table> tables_of(const RunRecord& record, const Summary& summary) {
  std::vector<Table> tables;
  if (!summary.rmse.empty()) tables.push_back(error_table(record, summary));
  if (record.stages) tables.push_back(stage_table(*record.stages));
  return tables;
}

}  // namespace

Chart stage_chart(const StageRecord& record, const std::string& title) {
  Chart chart{.title = title, .x_label = fmt::format("ms since step {} began", record.timeline_steps.front())};
  std::vector<double> first_row;
  for (const StageUse& stage : record.stages) {
    first_row.push_back(static_cast<double>(chart.rows.size()));
    for (std::size_t k = 0; k < stage.workers.size(); ++k)
      chart.rows.push_back(fmt::format("{} {}", stage.name, k + 1));
    if (!stage.workers.empty()) chart.bars.push_back({stage.name});
  }
  first_row.push_back(static_cast<double>(chart.rows.size()));
  chart.rows.emplace_back("barrier");
  chart.bars.push_back({"barrier: sums, estimates, selection"});
  for (const StageSpan& span : record.timeline) {
    const bool barrier = span.stage >= record.stages.size();
    Bars& bars = barrier ? chart.bars.back() : chart.bars[span.stage];
    bars.begin.push_back(1e3 * span.begin);
    bars.end.push_back(1e3 * span.end);
    bars.row.push_back(first_row[span.stage] + static_cast<double>(span.worker));
  }
  return chart;
}

Page run_page(const RunRecord& record, const Summary& summary, const Recording& recording, const Truth* truth,
              const std::string& source, const std::string& command) {
  Page page{.title = fmt::format("{} by {}", record.model, name_of(record.plan.filter))};
  page.summary =
      fmt::format("{} steps of {}, filtered with {} particles.", record.rows.size(), source, record.plan.particles);
  if (const auto& p = summary.position_error)
    page.summary += fmt::format(" Position error: median {:.3g}, mean {:.3g}.", p->median, p->mean);
  page.command = command;
  page.facts = facts_of(record, summary, source);
  page.charts = charts_of(record, summary, recording, truth);
  page.tables = tables_of(record, summary);
  if (record.stages)
    page.notes.push_back(fmt::format(
        "{} threads ran the stages; these were at work for {:.3g} s and waited {:.3g} s for what a step does once: "
        "sums, estimates, selection. A queue counts the blocks that waited when a worker took one up.",
        record.stages->threads, record.stages->seconds, record.stages->barrier_seconds));
  if (summary.collapses > 0)
    page.notes.push_back(fmt::format(
        "At {} steps every particle had weight zero; the filter went on as --on-collapse says.", summary.collapses));
  return page;
}

}  // namespace mote::report

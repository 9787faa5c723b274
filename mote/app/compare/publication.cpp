#include "mote/app/compare/publication.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/files/output.hpp"

namespace mote::compare {
namespace {

using nlohmann::json;

std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  return fmt::format("{:.3g}", value);
}

std::string with_interval(const Estimate& e) {
  if (std::isnan(e.interval.low)) return short_number(e.value);
  return fmt::format("{} [{}, {}]", short_number(e.value), short_number(e.interval.low), short_number(e.interval.high));
}

/// "x", "position"
std::string error_name(const Outcome& outcome) {
  const Design& d = outcome.design;
  return fmt::format("MSE of {} to the {}", d.target.name,
                     d.reference.name.empty() ? "truth"
                     : d.reference.exact      ? "exact mean"
                                              : "reference");
}

std::string headline(const Outcome& outcome) {
  const Design& d = outcome.design;
  std::string line = fmt::format("{}: {}, {} repeat{} (filter seeds {} to {})", d.model, outcome.source, d.repeats,
                                 d.repeats == 1 ? "" : "s", d.seed, d.seed_of(d.scenes.size() - 1, d.repeats - 1));
  if (!d.reference.name.empty()) line += fmt::format("; reference: {}", d.reference.name);
  return line;
}

bool has_groups(const Design& design) {
  return std::any_of(design.contenders.begin(), design.contenders.end(), [](const Contender& contender) {
    return contender.plans.front().filter == FilterKind::kDistributed;
  });
}

std::vector<std::string> notes_of(const Outcome& outcome) {
  const Design& d = outcome.design;
  std::vector<std::string> notes{
      fmt::format("{}: mean over the steps, median over the runs; ratio: of medians, to the first filter's.",
                  error_name(outcome)),
      fmt::format("[ ]: 95 % intervals by {} bootstrap samples of {}, the filters paired.", kResamples,
                  d.scenes.size() > 1 ? "recordings and repeats" : "repeats")};
  if (!d.reference.name.empty() && !d.reference.exact)
    notes.push_back(fmt::format("The reference has seed {}; its own Monte-Carlo error is in every MSE.",
                                d.seed_of(d.scenes.size(), 0)));
  if (d.has_truth()) {
    notes.emplace_back("RMSE: to the truth, over all steps and runs.");
    const Interval band = outcome.figures.front().back().nees_band;
    notes.push_back(
        fmt::format("NEES: squared error of all states by their posterior covariance; calibrated: [{:.3g}, {:.3g}] (95 "
                    "%, Gaussian, "
                    "steps independent).",
                    band.low, band.high));
    notes.emplace_back("cover: share of steps with the truth inside the 95 % region of that covariance.");
  }
  if (outcome.lost_beyond)
    notes.push_back(fmt::format("lost: runs that collapsed or end more than {:g} {} from the true {}.",
                                *outcome.lost_beyond, d.target.unit, d.target.name));
  notes.emplace_back(
      "collapsed: runs in which all weights were zero; where they ended there, their errors are infinite.");
  if (has_groups(d))
    notes.emplace_back("messages, bytes: sent between groups a step, each group taken for a processor; medians.");
  notes.emplace_back("ns, s: time per particle and step, and of a run; medians, the filters taking turns.");
  return notes;
}

/// The columns of the table, each with its text for a row.
struct Column {
  std::string name;
  std::function<std::string(std::size_t contender, std::size_t size)> text;
};

std::vector<Column> columns_of(const Outcome& outcome) {
  const Design& d = outcome.design;
  const auto number = [&](double Figures::*value) {
    return [&outcome, value](std::size_t c, std::size_t s) { return short_number(outcome.figures[c][s].*value); };
  };
  const auto& figures = outcome.figures;
  std::vector<Column> columns{
      {"filter", [&](std::size_t c, std::size_t) { return outcome.design.contenders[c].name; }},
      {"N", [&](std::size_t, std::size_t s) { return std::to_string(outcome.design.particles[s]); }}};
  if (d.has_truth()) columns.push_back({"RMSE", number(&Figures::rmse_truth)});
  columns.push_back({"MSE", [&](std::size_t c, std::size_t s) { return with_interval(figures[c][s].median_mse); }});
  if (d.contenders.size() > 1)
    columns.push_back({"ratio", [&](std::size_t c, std::size_t s) {
                         return figures[c][s].ratio ? with_interval(*figures[c][s].ratio) : "1";
                       }});
  if (d.has_truth()) columns.push_back({"NEES", number(&Figures::nees)});
  if (d.has_truth()) columns.push_back({"cover", number(&Figures::coverage)});
  columns.push_back(
      {"collapsed", [&](std::size_t c, std::size_t s) { return std::to_string(figures[c][s].collapsed); }});
  if (outcome.lost_beyond)
    columns.push_back({"lost", [&](std::size_t c, std::size_t s) { return std::to_string(*figures[c][s].lost); }});
  columns.push_back({"log evidence",
                     [&](std::size_t c, std::size_t s) { return fmt::format("{:.6g}", figures[c][s].log_evidence); }});
  columns.push_back({"its sd", number(&Figures::log_evidence_sd)});
  if (has_groups(d)) columns.push_back({"messages", number(&Figures::messages_per_step)});
  if (has_groups(d)) columns.push_back({"bytes", number(&Figures::bytes_per_step)});
  columns.push_back({"ns", number(&Figures::ns_per_particle_step)});
  columns.push_back({"s", number(&Figures::seconds)});
  return columns;
}

/// The table with its header: (1 + contenders x numbers, columns).
std::vector<std::vector<std::string>> cells_of(const Outcome& outcome) {
  const std::vector<Column> columns = columns_of(outcome);
  std::vector<std::vector<std::string>> cells(1);
  for (const Column& column : columns) cells.front().push_back(column.name);
  for (std::size_t s = 0; s < outcome.design.particles.size(); ++s)
    for (std::size_t c = 0; c < outcome.design.contenders.size(); ++c) {
      auto& row = cells.emplace_back();
      for (const Column& column : columns) row.push_back(column.text(c, s));
    }
  return cells;
}

/// An interval that a page does not break into lines.
std::string unbroken(std::string cell) {
  if (!cell.ends_with(']')) return cell;
  for (std::size_t at = 0; (at = cell.find(' ', at)) != std::string::npos;) cell.replace(at, 1, "\u00a0");
  return cell;
}

/// JSON has no infinities: null stands for "not a number".
json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json interval_json(const Interval& interval) { return {number(interval.low), number(interval.high)}; }

json figures_json(const Figures& f) {
  json out{{"rmse_truth", number(f.rmse_truth)},
           {"mse_median", number(f.median_mse.value)},
           {"mse_median_interval", interval_json(f.median_mse.interval)},
           {"mse_mean", number(f.mean_mse.value)},
           {"mse_mean_interval", interval_json(f.mean_mse.interval)},
           {"ratio", nullptr},
           {"ratio_interval", nullptr},
           {"nees", number(f.nees)},
           {"nees_band", interval_json(f.nees_band)},
           {"coverage", number(f.coverage)},
           {"collapsed", f.collapsed},
           {"lost", nullptr},
           {"log_evidence", number(f.log_evidence)},
           {"log_evidence_sd", number(f.log_evidence_sd)},
           {"seconds", number(f.seconds)},
           {"ns_per_particle_step", number(f.ns_per_particle_step)},
           {"messages_per_step", number(f.messages_per_step)},
           {"bytes_per_step", number(f.bytes_per_step)}};
  if (f.lost) out["lost"] = *f.lost;
  if (!f.ratio) return out;
  out["ratio"] = number(f.ratio->value);
  out["ratio_interval"] = interval_json(f.ratio->interval);
  return out;
}

json run_json(const Measured& run) {
  return {{"recording", run.recording + 1},
          {"seed", run.seed},
          {"mse_truth", number(run.mse_truth)},
          {"mse_reference", number(run.mse_reference)},
          {"nees", number(run.nees / run.nees_dof)},
          {"final_error", number(run.final_error)},
          {"log_evidence", number(run.log_evidence)},
          {"collapsed", run.collapsed},
          {"seconds", number(run.seconds)}};
}

json design_json(const Outcome& outcome) {
  const Design& d = outcome.design;
  json out{{"model", d.model},           {"source", outcome.source},
           {"command", outcome.command}, {"recordings", d.scenes.size()},
           {"repeats", d.repeats},       {"seed", d.seed},
           {"state", d.target.name},     {"confidence", kConfidence},
           {"resamples", kResamples},    {"lost_beyond", nullptr},
           {"reference", nullptr}};
  if (outcome.lost_beyond) out["lost_beyond"] = *outcome.lost_beyond;
  if (d.reference.name.empty()) return out;
  json evidence = json::array();
  for (const referee::Solution& solution : d.reference.solutions) evidence.push_back(number(solution.log_evidence));
  out["reference"] = {{"name", d.reference.name}, {"exact", d.reference.exact}, {"log_evidence", std::move(evidence)}};
  return out;
}

report::Chart chart_of(const Outcome& outcome) {
  const Design& d = outcome.design;
  report::Chart chart{.title = fmt::format("{}: error against wall-clock", d.model),
                      .x_label = "seconds a run",
                      .y_label = error_name(outcome) + (d.target.unit.empty() ? "" : " (" + d.target.unit + "²)"),
                      .log_x = true,
                      .log_y = true};
  for (std::size_t c = 0; c < d.contenders.size(); ++c) {
    report::Series curve{.name = d.contenders[c].name, .mark = report::Series::Mark::kMarkedLine};
    for (const Figures& f : outcome.figures[c]) {
      curve.x.push_back(f.seconds);
      curve.y.push_back(f.median_mse.value);
    }
    chart.series.push_back(std::move(curve));
  }
  return chart;
}

std::string field(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return "\"" + quoted + "\"";
}

std::string table_of(const Outcome& outcome) {
  const auto cells = cells_of(outcome);
  std::vector<std::size_t> widths(cells.front().size());
  for (const auto& row : cells)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text = headline(outcome) + "\n";
  for (const auto& row : cells) {
    std::string line = fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
    text += line + "\n";
  }
  for (const std::string& note : notes_of(outcome)) text += note + "\n";
  return text;
}

std::string csv_rows(const Outcome& outcome) {
  std::string csv;
  const auto three = [](const Estimate& e) {
    return fmt::format("{},{},{}", exact(e.value), exact(e.interval.low), exact(e.interval.high));
  };
  for (std::size_t c = 0; c < outcome.figures.size(); ++c)
    for (std::size_t s = 0; s < outcome.figures[c].size(); ++s) {
      const Figures& f = outcome.figures[c][s];
      csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", outcome.design.model,
                         field(outcome.design.contenders[c].name), outcome.design.particles[s], exact(f.rmse_truth),
                         three(f.median_mse), three(f.mean_mse), f.ratio ? three(*f.ratio) : ",,", exact(f.nees),
                         exact(f.nees_band.low), exact(f.nees_band.high), exact(f.coverage), f.collapsed,
                         f.lost ? std::to_string(*f.lost) : "", exact(f.log_evidence), exact(f.log_evidence_sd),
                         exact(f.seconds), exact(f.ns_per_particle_step), exact(f.messages_per_step),
                         exact(f.bytes_per_step));
    }
  return csv;
}

json results_json(const Outcome& outcome) {
  json out = design_json(outcome);
  out["results"] = json::array();
  for (std::size_t c = 0; c < outcome.figures.size(); ++c)
    for (std::size_t s = 0; s < outcome.figures[c].size(); ++s) {
      json row = figures_json(outcome.figures[c][s]);
      row["filter"] = outcome.design.contenders[c].name;
      row["particles"] = outcome.design.particles[s];
      row["runs"] = json::array();
      for (const Measured& run : outcome.runs[c][s]) row["runs"].push_back(run_json(run));
      out["results"].push_back(std::move(row));
    }
  return out;
}

std::string models_in(std::span<const Outcome> outcomes) {
  std::string names = outcomes.front().design.model;
  for (const Outcome& outcome : outcomes.subspan(1)) names += ", " + outcome.design.model;
  return names;
}

/// The facts, figure, table and notes of one model, each with its name.
void add_to(report::Page& page, const Outcome& outcome) {
  const Design& d = outcome.design;
  page.facts.insert(page.facts.end(),
                    {{"Model", d.model},
                     {"Data", outcome.source},
                     {"Repeats", std::to_string(d.repeats)},
                     {"Error of", d.target.name},
                     {"Reference", d.reference.name.empty() ? "none; errors are to the truth" : d.reference.name}});
  page.charts.push_back(chart_of(outcome));
  auto cells = cells_of(outcome);
  for (auto& row : cells)
    for (std::string& cell : row) cell = unbroken(std::move(cell));
  report::Table& table = page.tables.emplace_back();
  table.title = fmt::format("{}: filters by number of particles", d.model);
  table.columns = cells.front();
  table.rows.assign(cells.begin() + 1, cells.end());
  for (const std::string& note : notes_of(outcome))
    if (std::find(page.notes.begin(), page.notes.end(), note) == page.notes.end()) page.notes.push_back(note);
}

}  // namespace

std::string comparison_table(std::span<const Outcome> outcomes) {
  std::string text;
  for (const Outcome& outcome : outcomes) text += (text.empty() ? "" : "\n") + table_of(outcome);
  return text;
}

std::string comparison_csv(std::span<const Outcome> outcomes) {
  std::string csv =
      "model,filter,particles,rmse_truth,mse_median,mse_median_low,mse_median_high,mse_mean,mse_mean_low,mse_mean_high,"
      "ratio,ratio_low,ratio_high,nees,nees_low,nees_high,coverage,collapsed,lost,log_evidence,log_evidence_sd,seconds,"
      "ns_per_particle_step,messages_per_step,bytes_per_step\n";
  for (const Outcome& outcome : outcomes) csv += csv_rows(outcome);
  return csv;
}

json comparison_json(std::span<const Outcome> outcomes) {
  if (outcomes.size() == 1) return results_json(outcomes.front());
  json all = json::array();
  for (const Outcome& outcome : outcomes) all.push_back(results_json(outcome));
  return all;
}

report::Page comparison_page(std::span<const Outcome> outcomes) {
  report::Page page{.title = models_in(outcomes) + ": filters compared"};
  for (const Outcome& outcome : outcomes) page.summary += (page.summary.empty() ? "" : " ") + headline(outcome) + ".";
  page.command = outcomes.front().command;
  for (const Outcome& outcome : outcomes) add_to(page, outcome);
  return page;
}

}  // namespace mote::compare

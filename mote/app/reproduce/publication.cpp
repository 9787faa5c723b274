#include "mote/app/reproduce/publication.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/files/output.hpp"

namespace mote::reproduce {
namespace {

using report::Chart;
using report::Series;

std::string paper_text(const Comparison& c) {
  if (const auto* number = std::get_if<double>(&c.paper)) return fmt::format("{:.6g}", *number);
  if (const auto* text = std::get_if<std::string>(&c.paper)) return *text;
  return "not printed";
}

std::string condition(const Comparison& c) {
  if (c.at_least && c.at_most) return fmt::format("{:g} to {:g}", *c.at_least, *c.at_most);
  if (c.at_most) return fmt::format("at most {:g}", *c.at_most);
  if (c.at_least) return fmt::format("at least {:g}", *c.at_least);
  return "shown";
}

std::size_t place_of(const std::vector<Quantity>& states, const std::string& name) {
  std::size_t d = 0;
  while (d < states.size() && states[d].name != name) ++d;
  return d;
}

Chart track(const Figure& figure, const Outcome& outcome) {
  const std::size_t ix = place_of(outcome.states, "x");
  const std::size_t iy = place_of(outcome.states, "y");
  Chart chart{.title = figure.title,
              .x_label = "x (" + outcome.states[ix].unit + ")",
              .y_label = "y (" + outcome.states[iy].unit + ")",
              .equal_axes = true};
  for (const auto& [name, record] : outcome.records) {
    Series series{.name = name};
    for (const EstimateRow& row : record.rows) {
      series.x.push_back(row.states[ix].mean);
      series.y.push_back(row.states[iy].mean);
    }
    chart.series.push_back(std::move(series));
  }
  Series truth{.name = "truth"};
  for (const auto& [t, x] : outcome.truth.states) {
    truth.x.push_back(x[ix]);
    truth.y.push_back(x[iy]);
  }
  chart.series.push_back(std::move(truth));
  return chart;
}

Chart over_time(const Figure& figure, const Outcome& outcome) {
  const std::size_t d = place_of(outcome.states, figure.state);
  const Quantity& state = outcome.states[d];
  const std::string unit = state.unit.empty() ? "" : " (" + state.unit + ")";
  Chart chart{.title = figure.title,
              .x_label = "t",
              .y_label = (figure.error ? "|error of " + state.name + "|" : state.name) + unit};
  for (const auto& [name, record] : outcome.records) {
    Series series{.name = name};
    for (const EstimateRow& row : record.rows) {
      const double error = row.states[d].mean - outcome.truth.states.at(row.t)[d];
      series.x.push_back(row.t);
      series.y.push_back(figure.error ? std::abs(state.angle ? numbers::wrap(error) : error) : row.states[d].mean);
    }
    chart.series.push_back(std::move(series));
  }
  if (figure.error) return chart;
  Series truth{.name = "truth"};
  for (const auto& [t, x] : outcome.truth.states) {
    truth.x.push_back(t);
    truth.y.push_back(x[d]);
  }
  chart.series.push_back(std::move(truth));
  return chart;
}

}  // namespace

nlohmann::json comparison_json(const std::vector<Regenerated>& all) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [item, outcome] : all)
    for (const Result& result : outcome.results) {
      nlohmann::json entry{{"item", item.paper + " " + item.name + ": " + result.asked.name},
                           {"ours", nullptr},
                           {"paper", nullptr},
                           {"ratio", nullptr},
                           {"holds", result.holds}};
      if (std::isfinite(result.ours)) entry["ours"] = result.ours;
      if (const auto* number = std::get_if<double>(&result.asked.paper)) entry["paper"] = *number;
      if (const auto* text = std::get_if<std::string>(&result.asked.paper)) entry["paper"] = *text;
      if (result.ratio) entry["ratio"] = *result.ratio;
      entry["note"] =
          fmt::format("{}, {} repeats; holds when {}{}{}", word_for(result.asked.kind), result.asked.repeats,
                      condition(result.asked), result.asked.note.empty() ? "" : ". ", result.asked.note);
      list.push_back(std::move(entry));
    }
  return list;
}

report::Page page_of(const std::string& paper, const std::vector<Regenerated>& all, const std::string& command) {
  report::Page page{.title = "Reproduced: " + paper, .command = command};
  std::size_t holding = 0;
  report::Table table{.title = "Comparison with the papers",
                      .columns = {"Item", "Compared", "Paper", "Ours", "Condition", "Holds"}};
  for (const auto& [item, outcome] : all) {
    for (const Result& result : outcome.results) {
      holding += result.holds ? 1 : 0;
      table.rows.push_back({item.paper + " " + item.name, result.asked.name, paper_text(result.asked),
                            fmt::format("{:.4g}", result.ours), condition(result.asked), result.holds ? "yes" : "no"});
    }
    for (const Figure& figure : item.figures) {
      Figure named = figure;
      named.title = item.paper + " " + item.name + ": " + figure.title;
      page.charts.push_back(figure.state.empty() ? track(named, outcome) : over_time(named, outcome));
    }
    page.notes.push_back(fmt::format("{} {} – {}. Printed: {}{}{}", item.paper, item.name, item.title, item.printed,
                                     item.note.empty() ? "" : " Note: ", item.note));
  }
  page.summary = fmt::format("{} items, {} of {} comparisons hold.", all.size(), holding, table.rows.size());
  page.tables.push_back(std::move(table));
  return page;
}

std::string figure_csv(const Outcome& outcome) {
  std::string csv = "t";
  for (const Quantity& state : outcome.states) csv += ",truth_" + state.name;
  for (const auto& [name, record] : outcome.records)
    for (const Quantity& state : outcome.states)
      csv += "," + name + "_" + state.name + "_mean," + name + "_" + state.name + "_sd";
  csv += '\n';
  for (std::size_t k = 0; k < outcome.records.front().second.rows.size(); ++k) {
    const Step t = outcome.records.front().second.rows[k].t;
    csv += std::to_string(t);
    for (const double x : outcome.truth.states.at(t)) csv += "," + exact(x);
    for (const auto& [name, record] : outcome.records)
      for (const Moments& m : record.rows[k].states) csv += "," + exact(m.mean) + "," + exact(m.sd);
    csv += '\n';
  }
  return csv;
}

std::string slug(const Item& item) {
  std::string out;
  for (const char c : item.paper + "-" + item.name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (c >= 'A' && c <= 'Z') {
      out += static_cast<char>(c - 'A' + 'a');
    } else if (plain) {
      out += c;
    } else if (!out.empty() && out.back() != '-') {
      out += '-';
    }
  }
  while (out.ends_with('-')) out.pop_back();
  return out;
}

}  // namespace mote::reproduce

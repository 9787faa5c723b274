#include "mote/app/explore/publication.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mote::explore {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kShown = 24;  ///< rows of the frontier on a terminal

/// JSON has no infinities.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// What limits a figure: an option, or the target itself.
std::string budget_of(const Figure& figure) { return figure.option.empty() ? "the device" : figure.option; }

/// "time_s", "power_mw", "lut"
std::string key_of(const Figure& figure) {
  if (figure.unit.empty() || figure.unit.find(' ') != std::string::npos) return figure.name;
  std::string unit = figure.unit;
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  return figure.name + "_" + unit;
}

std::string label_of(const Figure& figure) {
  return figure.unit.empty() ? figure.name : fmt::format("{} ({})", figure.name, figure.unit);
}

Json candidate_json(const Exploration& found, std::size_t c) {
  const Standing& s = found.finding.standings[c];
  Json json{{"words", fmt::format("{}", fmt::join(found.target->candidates()[c], " "))},
            {"command", found.command_of(c)},
            {"runs", s.runs},
            {"collapsed", s.collapsed},
            {"rmse", nullptr},
            {"rmse_interval", nullptr},
            {"rmse_truth", nullptr}};
  const std::vector<Figure> figures = found.target->figures();
  for (std::size_t f = 0; f < figures.size(); ++f) json[key_of(figures[f])] = number(s.takes[f]);
  if (s.runs == 0) return json;
  json["rmse"] = number(s.rmse);
  json["rmse_interval"] = {number(s.interval.low), number(s.interval.high)};
  json["rmse_truth"] = number(s.rmse_truth);
  return json;
}

Json pick_json(const Exploration& found) {
  Json json = candidate_json(found, found.finding.pick);
  json["feasible"] = found.finding.feasible;
  json["breaks"] = Json::array();
  for (const std::size_t k : found.finding.broken) {
    const design::Limit& limit = found.order.limits[k];
    json["breaks"].push_back({{"budget", budget_of(found.figures()[limit.figure])},
                              {"factor", number(found.value(found.finding.pick, limit.figure) / limit.most)}});
  }
  return json;
}

Json limits_json(const Exploration& found) {
  Json all = Json::object();
  for (const design::Limit& limit : found.order.limits) {
    const Figure figure = found.figures()[limit.figure];
    all[budget_of(figure)] = {{"figure", key_of(figure)}, {"most", limit.most}};
  }
  return all;
}

std::vector<std::string> header_of(const Exploration& found) {
  std::vector<std::string> cells{"RMSE", "95 %", "runs"};
  for (const Figure& figure : found.target->figures()) cells.push_back(label_of(figure));
  cells.emplace_back("candidate");
  return cells;
}

std::vector<std::string> cells_of(const Exploration& found, std::size_t c) {
  const Standing& s = found.finding.standings[c];
  std::vector<std::string> cells{fmt::format("{:.4g}", s.rmse),
                                 fmt::format("{:.3g} .. {:.3g}", s.interval.low, s.interval.high),
                                 std::to_string(s.runs)};
  for (const double value : s.takes) cells.push_back(fmt::format("{:.4g}", value));
  cells.push_back(fmt::format("{}", fmt::join(found.target->candidates()[c], " ")));
  return cells;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) text += fmt::format("{:>{}}  ", row[i], widths[i]);
    text += row.back() + "\n";
  }
  return text;
}

/// "Pick: ..." or "Not feasible: nothing keeps --deadline. Nearest, over --deadline by a factor of 2: ..."
std::string verdict(const Exploration& found) {
  const Finding& f = found.finding;
  const Standing& s = f.standings[f.pick];
  std::string text = "Pick";
  if (!f.feasible) {
    std::vector<std::string> broken;
    for (const std::size_t k : f.broken) {
      const design::Limit& limit = found.order.limits[k];
      broken.push_back(fmt::format("{} by a factor of {:.3g}", budget_of(found.figures()[limit.figure]),
                                   found.value(f.pick, limit.figure) / limit.most));
    }
    text = fmt::format("Not feasible: nothing keeps all budgets. Nearest, over {}", fmt::join(broken, ", over "));
  }
  text += fmt::format(": RMSE {:.4g} ({:.3g} to {:.3g}, {} runs)", s.rmse, s.interval.low, s.interval.high, s.runs);
  const std::vector<Figure> figures = found.target->figures();
  for (std::size_t k = 0; k < figures.size(); ++k)
    text +=
        fmt::format(", {} {:.4g}{}", figures[k].name, s.takes[k], figures[k].unit.empty() ? "" : " " + figures[k].unit);
  return text;
}

bool judged(const Standing& s) { return s.runs > 0 && !s.collapsed; }

std::string headline(const Exploration& found) {
  const auto& all = found.finding.standings;
  const auto collapsed = std::count_if(all.begin(), all.end(), [](const Standing& s) { return s.collapsed; });
  return fmt::format("{} on {}: {} candidates, {} judged{}; RMSE of {} to the {}; {}", found.model,
                     found.target->name(), all.size(), std::count_if(all.begin(), all.end(), judged),
                     collapsed > 0 ? fmt::format(", {} collapsed", collapsed) : "", found.jury->design().target.name,
                     found.jury->design().reference.exact ? "exact means" : "means of a large run", found.source);
}

report::Series series_of(const Exploration& found, const std::string& name, const std::vector<std::size_t>& candidates,
                         std::size_t figure) {
  report::Series series{.name = name, .mark = report::Series::Mark::kPoints};
  for (const std::size_t c : candidates) {
    series.x.push_back(found.value(c, figure));
    series.y.push_back(found.finding.standings[c].rmse);
    series.labels.push_back(found.command_of(c));
  }
  return series;
}

report::Chart chart_of(const Exploration& found, std::size_t figure) {
  const Figure axis = found.target->figures()[figure];
  std::vector<std::size_t> others;
  const auto& frontier = found.finding.frontier;
  for (std::size_t c = 0; c < found.finding.standings.size(); ++c)
    if (judged(found.finding.standings[c]) && std::find(frontier.begin(), frontier.end(), c) == frontier.end())
      others.push_back(c);
  return {.title = fmt::format("Error against {}", axis.name),
          .x_label = label_of(axis) + (axis.name == "time" ? " a step" : ""),
          .y_label = fmt::format("RMSE of {}", found.jury->design().target.name),
          .series = {series_of(found, "beaten", others, figure), series_of(found, "frontier", frontier, figure),
                     series_of(found, "pick", {found.finding.pick}, figure)},
          .log_x = true,
          .log_y = true};
}

std::vector<std::string> notes_of(const Exploration& found) {
  const compare::Design& d = found.jury->design();
  return {fmt::format("Figures: {}.", found.target->meaning()),
          fmt::format("RMSE: of the estimated {} to the means of the {}, root of the mean over steps and runs; its "
                      "interval is of 95 % by the spread of the runs.",
                      d.target.name, d.reference.name),
          "Every candidate is judged on the same recordings by the same seeds; by successive halving the better half "
          "has twice as many runs.",
          "The frontier: candidates that nobody beats, all judged by as many runs.",
          "Whoever errs no more and takes no more, and somewhere less, beats another: by the runs that both had.",
          "Whoever collapsed, with all weights zero, is left out."};
}

}  // namespace

std::vector<Figure> Exploration::figures() const {
  std::vector<Figure> all = target->figures();
  all.push_back({"rmse", jury->design().target.unit, "--max-rmse"});
  return all;
}

double Exploration::value(std::size_t candidate, std::size_t figure) const {
  const Standing& s = finding.standings[candidate];
  return figure < s.takes.size() ? s.takes[figure] : s.rmse;
}

Json exploration_json(const Exploration& found) {
  const compare::Design& d = found.jury->design();
  Json frontier = Json::array();
  for (const std::size_t c : found.finding.frontier) frontier.push_back(candidate_json(found, c));
  Json all = Json::array();
  for (std::size_t c = 0; c < found.finding.standings.size(); ++c) all.push_back(candidate_json(found, c));
  return {{"model", found.model},
          {"target", found.target->name()},
          {"source", found.source},
          {"state", d.target.name},
          {"reference", {{"name", d.reference.name}, {"exact", d.reference.exact}}},
          {"goal", key_of(found.figures()[found.order.goal])},
          {"limits", limits_json(found)},
          {"candidates", found.finding.standings.size()},
          {"pick", pick_json(found)},
          {"frontier", std::move(frontier)},
          {"all", std::move(all)}};
}

std::string exploration_text(const Exploration& found) {
  std::vector<std::vector<std::string>> rows{header_of(found)};
  const auto& frontier = found.finding.frontier;
  for (std::size_t k = 0; k < std::min(frontier.size(), kShown); ++k) rows.push_back(cells_of(found, frontier[k]));
  std::string text = headline(found) + "\nFrontier\n" + aligned(rows);
  if (frontier.size() > kShown) text += fmt::format("... and {} more (--json, --report)\n", frontier.size() - kShown);
  return text + fmt::format("{}\n{}\n", verdict(found), found.command_of(found.finding.pick));
}

report::Page exploration_page(const Exploration& found) {
  report::Page page{.title = fmt::format("mote design explore {}", found.model), .summary = headline(found)};
  page.command = found.command;
  page.facts = {{"pick", verdict(found)}, {"its command", found.command_of(found.finding.pick)}};
  for (const design::Limit& limit : found.order.limits) {
    const Figure figure = found.figures()[limit.figure];
    page.facts.push_back({budget_of(figure), fmt::format("{:.6g} {}", limit.most, figure.unit)});
  }
  const std::vector<Figure> figures = found.target->figures();
  for (std::size_t f = 0; f < figures.size(); ++f)
    if (figures[f].axis) page.charts.push_back(chart_of(found, f));
  report::Table table{.title = "Frontier", .columns = header_of(found)};
  for (const std::size_t c : found.finding.frontier) table.rows.push_back(cells_of(found, c));
  page.tables.push_back(std::move(table));
  page.notes = notes_of(found);
  return page;
}

}  // namespace mote::explore

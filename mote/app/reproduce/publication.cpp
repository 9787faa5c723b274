#include "mote/app/reproduce/publication.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/reproduce/figures.hpp"
#include "mote/app/reproduce/script.hpp"

namespace mote::reproduce {
namespace {

std::string name_of(const Item& item) { return item.paper + " " + item.name; }

std::string paper_text(const Comparison& c) {
  if (const auto* number = std::get_if<double>(&c.paper)) return fmt::format("{:.6g}", *number);
  if (const auto* text = std::get_if<std::string>(&c.paper)) return "\"" + *text + "\"";
  return "not printed";
}

std::string interval_text(const compare::Interval& interval) {
  return fmt::format("[{:.3g}, {:.3g}]", interval.low, interval.high);
}

std::string ours_text(const Result& result) {
  std::string error = result.standard_error ? fmt::format(" ± {:.2g}", *result.standard_error) : "";
  if (result.interval) error = " " + interval_text(*result.interval);
  return std::isnan(result.ours) ? "no number" : fmt::format("{:.4g}{}", result.ours, error);
}

std::string note_of(const Result& result) {
  const Comparison& c = result.asked;
  std::string note = fmt::format("{}; {} repeats", meaning_of(c), c.repeats);
  if (result.standard_error) note += fmt::format(", standard error {:.2g}", *result.standard_error);
  if (result.interval) note += ", 95 % interval " + interval_text(*result.interval);
  return fmt::format("{}; holds when {}{}{}", note, condition_of(c), c.note.empty() ? "" : ". ", c.note);
}

std::size_t holding(const Outcome& outcome) {
  return static_cast<std::size_t>(
      std::count_if(outcome.results.begin(), outcome.results.end(), [](const Result& r) { return r.holds; }));
}

report::Table comparisons_table(const Item& item, const Outcome& outcome) {
  report::Table table{.title = name_of(item) + ": " + item.title,
                      .columns = {"Compared", "Paper", "Ours", "Error", "Ratio", "Holds when", "Holds", "Repeats"}};
  for (const Result& result : outcome.results)
    table.rows.push_back({result.asked.name, paper_text(result.asked),
                          std::isnan(result.ours) ? "no number" : fmt::format("{:.4g}", result.ours),
                          result.standard_error ? fmt::format("{:.2g}", *result.standard_error)
                          : result.interval     ? interval_text(*result.interval)
                                                : "",
                          result.ratio ? fmt::format("{:.3g}", *result.ratio) : "", condition_of(result.asked),
                          result.holds ? "yes" : "NO", std::to_string(result.asked.repeats)});
  return table;
}

/// What the comparisons mean, each kind once, and what is said about single ones.
std::vector<std::string> notes_on(const std::vector<Regenerated>& all) {
  std::vector<std::string> notes{
      "Error: of our number, over its repeats: its standard error (leaving out one at a time), or of medians a 95 % "
      "interval [ ] (bootstrap)."};
  for (const auto& [item, outcome] : all)
    for (const Result& result : outcome.results)
      if (const std::string note = meaning_of(result.asked) + ".";
          std::find(notes.begin(), notes.end(), note) == notes.end())
        notes.push_back(note);
  for (const auto& [item, outcome] : all) {
    for (const Result& result : outcome.results)
      if (!result.asked.note.empty())
        notes.push_back(fmt::format("{}, {}: {}.", name_of(item), result.asked.name, result.asked.note));
    for (const auto& [run, sweep] : outcome.sweeps)
      notes.push_back(
          fmt::format("{}, {}: {}, {}.", name_of(item), run, simulated::times_of(sweep.work), sweep.where_from));
    for (const std::string& sentence : outcome.left_out) notes.push_back(name_of(item) + ": " + sentence);
    for (const std::string& collapse : outcome.collapses) notes.push_back(name_of(item) + ", " + collapse);
  }
  return notes;
}

report::Table items_table(const std::vector<Regenerated>& all) {
  report::Table table{.title = "What the papers printed", .columns = {"Item", "Source", "Printed", "Read as"}};
  for (const auto& [item, outcome] : all) table.rows.push_back({name_of(item), item.source, item.printed, item.note});
  return table;
}

}  // namespace

nlohmann::json comparison_json(const std::vector<Regenerated>& all) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [item, outcome] : all)
    for (const Result& result : outcome.results) {
      nlohmann::json entry{{"item", name_of(item) + ": " + result.asked.name},
                           {"paper", nullptr},
                           {"ours", nullptr},
                           {"ratio", nullptr},
                           {"holds", result.holds},
                           {"note", note_of(result)}};
      if (std::isfinite(result.ours)) entry["ours"] = result.ours;
      if (const auto* number = std::get_if<double>(&result.asked.paper)) entry["paper"] = *number;
      if (const auto* text = std::get_if<std::string>(&result.asked.paper)) entry["paper"] = *text;
      if (result.ratio && std::isfinite(*result.ratio)) entry["ratio"] = *result.ratio;
      list.push_back(std::move(entry));
    }
  return list;
}

std::string comparison_text(const std::vector<Regenerated>& all) {
  std::string text;
  for (const auto& [item, outcome] : all)
    for (const Result& result : outcome.results)
      text += fmt::format("{:<14} {}: {}: {} (paper: {}; holds when {})\n", result.holds ? "holds" : "DOES NOT HOLD",
                          name_of(item), result.asked.name, ours_text(result), paper_text(result.asked),
                          condition_of(result.asked));
  for (const auto& [item, outcome] : all)
    for (const std::string& sentence : outcome.left_out) text += fmt::format("{}: {}\n", name_of(item), sentence);
  return text;
}

report::Page page_of(const std::string& paper, const std::vector<Regenerated>& all, const std::string& command) {
  report::Page page{.title = "Reproduced: " + paper, .command = command};
  std::size_t held = 0;
  std::size_t compared = 0;
  for (const auto& [item, outcome] : all) {
    held += holding(outcome);
    compared += outcome.results.size();
    page.facts.push_back({name_of(item), fmt::format("{} of {} hold", holding(outcome), outcome.results.size())});
    for (const Figure& figure : item.figures)
      if (figure.frames.empty()) page.charts.push_back(chart_of(item, figure, outcome));
    page.pictures.insert(page.pictures.end(), outcome.pictures.begin(), outcome.pictures.end());
    page.tables.push_back(comparisons_table(item, outcome));
    page.command += fmt::format("\n\n# {}: {}\n{}", name_of(item), item.title, script_for(item));
    page.command.pop_back();
  }
  if (all.empty()) {
    page.summary = "There are no items of this paper yet.";
    return page;
  }
  page.summary =
      fmt::format("{} item{}: {} of {} comparisons hold.", all.size(), all.size() == 1 ? "" : "s", held, compared);
  page.tables.push_back(items_table(all));
  page.notes = notes_on(all);
  return page;
}

}  // namespace mote::reproduce

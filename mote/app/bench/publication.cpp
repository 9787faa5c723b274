#include "mote/app/bench/publication.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/report/run_page.hpp"

namespace mote::bench {
namespace {

using nlohmann::json;

std::string short_number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3g}", value); }

std::string with_interval(const Ratio& ratio) {
  if (std::isnan(ratio.interval.low)) return short_number(ratio.value);
  return fmt::format("{} [{}, {}]", short_number(ratio.value), short_number(ratio.interval.low),
                     short_number(ratio.interval.high));
}

bool has_limit(const Outcome& outcome) {
  return std::any_of(outcome.results.begin(), outcome.results.end(),
                     [](const Result& r) { return !std::isnan(r.of_limit.value); });
}

bool has_law(const Outcome& outcome) {
  return std::any_of(outcome.results.begin(), outcome.results.end(),
                     [](const Result& r) { return !std::isnan(r.predicted); });
}

/// A column of a task's table.
struct Column {
  std::string name;
  std::function<std::string(const Result&)> text;
};

std::vector<Column> columns_of(const Outcome& outcome) {
  const std::string first = outcome.results.front().entrant;
  std::vector<Column> columns{
      {"contender", [](const Result& r) { return r.entrant; }},
      {"N", [](const Result& r) { return std::to_string(r.particles); }},
      {"ns", [](const Result& r) { return short_number(r.ns.median); }},
      {"quartiles",
       [](const Result& r) { return fmt::format("{} to {}", short_number(r.ns.low), short_number(r.ns.high)); }},
      {"x " + first, [first](const Result& r) { return r.entrant == first ? "1" : with_interval(r.to_first); }}};
  if (has_limit(outcome))
    columns.push_back(
        {"of limit", [](const Result& r) { return r.entrant == "limit" ? "1" : with_interval(r.of_limit); }});
  if (has_law(outcome)) {
    columns.push_back({"predicted", [](const Result& r) { return short_number(r.predicted); }});
    columns.push_back({"x predicted", [](const Result& r) { return with_interval(r.to_predicted); }});
    return columns;
  }
  columns.push_back({"bytes", [](const Result& r) { return short_number(r.bytes); }});
  columns.push_back({"GB/s", [](const Result& r) { return short_number(r.bytes / r.ns.median); }});
  columns.push_back({"MB", [](const Result& r) { return short_number(r.memory / 1e6); }});
  return columns;
}

/// The table with its header: (1 + results, columns).
std::vector<std::vector<std::string>> cells_of(const Outcome& outcome) {
  const std::vector<Column> columns = columns_of(outcome);
  std::vector<std::vector<std::string>> cells(1);
  for (const Column& column : columns) cells.front().push_back(column.name);
  for (const Result& result : outcome.results) {
    auto& row = cells.emplace_back();
    for (const Column& column : columns) row.push_back(column.text(result));
  }
  return cells;
}

std::string aligned(const std::vector<std::vector<std::string>>& cells) {
  std::vector<std::size_t> widths(cells.front().size());
  for (const auto& row : cells)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const auto& row : cells) {
    text += fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += "\n";
  }
  return text;
}

std::string absent_sentence(const Absent& absent) {
  return fmt::format("{} is left out: {}.", absent.entrant, absent.why);
}

std::vector<std::string> notes_of(const Report& report) {
  std::vector<std::string> notes;
  notes.push_back(
      fmt::format("ns: per particle and step, median of {} rounds in which all took turns; CPU time of the thread, for "
                  "the tasks threads, ranks and pipeline wall-clock.",
                  report.repeats));
  notes.emplace_back(
      "x, of limit: ratios of times within a round, their median and 95 % interval (bootstrap of rounds).");
  notes.emplace_back("bytes: read and written at least per particle and step (derived); GB/s: bytes by ns.");
  if (std::any_of(report.outcomes.begin(), report.outcomes.end(), has_law))
    notes.emplace_back("predicted: by the latency law of the setting (docs/pipeline.md), from the cost of its stages.");
  notes.emplace_back("MB: memory held after a run.");
  notes.emplace_back("Every answer was checked before anything was timed; --json has the verdicts.");
  return notes;
}

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
json interval_json(const compare::Interval& interval) { return {number(interval.low), number(interval.high)}; }

json check_json(const Checked& check) {
  const Verdict& v = check.verdict;
  return {{"contender", check.entrant},
          {"measure", v.measure},
          {"value", number(v.value)},
          {"low", number(v.low)},
          {"high", number(v.high)}};
}

json result_json(const Result& r) {
  return {{"contender", r.entrant},
          {"particles", r.particles},
          {"ns_per_particle_step", number(r.ns.median)},
          {"ns_quartiles", {number(r.ns.low), number(r.ns.high)}},
          {"ratio_to_first", number(r.to_first.value)},
          {"ratio_to_first_interval", interval_json(r.to_first.interval)},
          {"fraction_of_limit", number(r.of_limit.value)},
          {"fraction_of_limit_interval", interval_json(r.of_limit.interval)},
          {"predicted_ns", number(r.predicted)},
          {"ratio_to_predicted", number(r.to_predicted.value)},
          {"ratio_to_predicted_interval", interval_json(r.to_predicted.interval)},
          {"bytes_per_particle_step", number(r.bytes)},
          {"gigabytes_per_second", number(r.bytes / r.ns.median)},
          {"memory_bytes", number(r.memory)},
          {"rounds", r.rounds}};
}

json outcome_json(const Outcome& o) {
  json out{
      {"task", o.task},          {"meaning", o.meaning},    {"clock", o.clock == Clock::kThread ? "thread" : "wall"},
      {"steps", o.steps},        {"checks", json::array()}, {"left_out", json::array()},
      {"results", json::array()}};
  for (const Checked& check : o.checks) out["checks"].push_back(check_json(check));
  for (const Absent& absent : o.absent) out["left_out"].push_back({{"contender", absent.entrant}, {"why", absent.why}});
  for (const Result& result : o.results) out["results"].push_back(result_json(result));
  return out;
}

report::Chart chart_of(const Outcome& outcome) {
  report::Chart chart{.title = outcome.task + ": time of a particle and step",
                      .x_label = "particles",
                      .y_label = "ns",
                      .log_x = true,
                      .log_y = true};
  for (const Result& result : outcome.results) {
    auto curve = std::find_if(chart.series.begin(), chart.series.end(),
                              [&](const report::Series& s) { return s.name == result.entrant; });
    if (curve == chart.series.end())
      curve = chart.series.insert(curve, {.name = result.entrant, .mark = report::Series::Mark::kMarkedLine});
    curve->x.push_back(static_cast<double>(result.particles));
    curve->y.push_back(result.ns.median);
  }
  return chart;
}

}  // namespace

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string name = "an unnamed processor";
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) name = line.substr(line.find(": ") + 2);
  const unsigned cores = std::thread::hardware_concurrency();
  return fmt::format("{}, {} core{}", name, cores, cores == 1 ? "" : "s");
}

std::string bench_table(const Report& report) {
  std::string text = report.machine + "\n";
  for (const Outcome& outcome : report.outcomes) {
    text += fmt::format("\n{}: {}\n", outcome.task, outcome.meaning);
    text += aligned(cells_of(outcome));
    for (const Absent& absent : outcome.absent) text += absent_sentence(absent) + "\n";
  }
  text += "\n";
  for (const std::string& note : notes_of(report)) text += note + "\n";
  return text;
}

json bench_json(const Report& report) {
  json out{{"command", report.command},
           {"machine", report.machine},
           {"repeats", report.repeats},
           {"confidence", compare::kConfidence},
           {"tasks", json::array()}};
  for (const Outcome& outcome : report.outcomes) out["tasks"].push_back(outcome_json(outcome));
  return out;
}

report::Page bench_page(const Report& report) {
  report::Page page{.title = "mote bench", .summary = fmt::format("Measured on {}.", report.machine)};
  page.command = report.command;
  for (const Outcome& outcome : report.outcomes) {
    page.charts.push_back(chart_of(outcome));
    for (const auto& [name, stages] : outcome.stages)
      page.charts.push_back(report::stage_chart(stages, fmt::format("{}: stages of {}", outcome.task, name)));
    auto cells = cells_of(outcome);
    page.tables.push_back({.title = outcome.task + ": " + outcome.meaning, .columns = cells.front()});
    page.tables.back().rows.assign(cells.begin() + 1, cells.end());
    for (const Absent& absent : outcome.absent) page.notes.push_back(outcome.task + ": " + absent_sentence(absent));
  }
  for (const std::string& note : notes_of(report)) page.notes.push_back(note);
  return page;
}

}  // namespace mote::bench

#include "mote/app/files/recording_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

constexpr Step kLongestGap = 10'000'000;

std::string listed(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ",")); }

/// Where each of the model's columns is in the table; nothing for an input that is not there.
std::vector<std::optional<std::size_t>> places_of(const Table& table, const std::vector<Column>& columns,
                                                  const std::string& model) {
  std::vector<std::optional<std::size_t>> places;
  for (const Column& column : columns) {
    places.push_back(table.column(column.name));
    if (!places.back() && !column.input)
      throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", table.path, table.header_line), "header",
                                         fmt::format("a column \"{}\" for {}", column.name, model),
                                         in_quotes(listed(table.header)), "See mote models " + model + "."});
  }
  return places;
}

Row<double> row_from(const Table& table, const Table::Line& line, const std::vector<Column>& columns,
                     const std::vector<std::optional<std::size_t>>& places) {
  Row<double> row;
  bool seen = false;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double value = places[j] ? number_field(table, line, *places[j]) : columns[j].fallback;
    row.values.push_back(value);
    row.present.push_back(!std::isnan(value));
    seen = seen || (!columns[j].input && !std::isnan(value));
  }
  for (std::size_t j = 0; seen && j < columns.size(); ++j)
    if (columns[j].input && !row.seen(j))
      throw Refusal(ExitCode::kBadData, {table.where(line), fmt::format("column \"{}\"", columns[j].name),
                                         "a finite number, since the row is observed", "a missing value",
                                         "Leave the observation empty too if the row is not to be used."});
  return row;
}

void check_time(const Table& table, const Table::Line& line, Step before, Step t) {
  if (t < before)
    throw Refusal(ExitCode::kBadData, {table.where(line), "column \"t\"",
                                       fmt::format("at least {}, the time before (t never decreases)", before),
                                       std::to_string(t), "Sort the rows by t."});
  if (t - before > kLongestGap)
    throw Refusal(
        ExitCode::kBadData,
        {table.where(line), "column \"t\"", fmt::format("a gap of at most {} steps after {}", kLongestGap, before),
         std::to_string(t), "Steps are predicted one by one from t = 0; number them from 1."});
}

bool observed(const Row<double>& row, const std::vector<Column>& columns) {
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (!columns[j].input && row.seen(j)) return true;
  return false;
}

}  // namespace

Recording recording_from(const Table& table, const std::vector<Column>& columns, const std::string& model) {
  const auto places = places_of(table, columns, model);
  Recording recording;
  for (const Column& column : columns)
    if (!column.input) recording.observations.push_back(column);
  for (const auto& line : table.lines) {
    const Step t = time_field(table, line);
    const Step before = recording.steps.empty() ? 0 : recording.steps.back().t;
    check_time(table, line, before, t);
    if (recording.steps.empty() || t > before) recording.steps.push_back({t, {}});
    const Row<double> row = row_from(table, line, columns, places);
    if (!observed(row, columns)) continue;
    recording.steps.back().rows.push_back(row);
  }
  return recording;
}

Truth truth_from(const Table& table, const std::vector<Quantity>& states) {
  std::vector<std::optional<std::size_t>> places;
  std::vector<std::string> names;
  Truth truth;
  for (const Quantity& state : states) {
    places.push_back(table.column(state.name));
    truth.known.push_back(places.back().has_value());
    names.push_back(state.name);
  }
  if (std::none_of(truth.known.begin(), truth.known.end(), [](bool k) { return k; }))
    throw Refusal(ExitCode::kBadData,
                  {fmt::format("{}:{}", table.path, table.header_line), "header",
                   "at least one state of the model (" + listed(names) + ")", in_quotes(listed(table.header)),
                   "Name the columns of the truth like the states."});
  Step before = 0;
  for (const auto& line : table.lines) {
    const Step t = time_field(table, line);
    if (t <= before)
      throw Refusal(ExitCode::kBadData, {table.where(line), "column \"t\"",
                                         fmt::format("more than {}, the time before (one true state a step)", before),
                                         std::to_string(t), "Sort the rows by t."});
    before = t;
    std::vector<double>& x = truth.states[t];
    for (const auto& place : places) x.push_back(place ? number_field(table, line, *place) : kNaN);
  }
  return truth;
}

std::vector<std::string> unused_columns(const Table& table, const std::vector<std::string>& read) {
  std::vector<std::string> unused;
  for (const std::string& name : table.header)
    if (name != "t" && std::find(read.begin(), read.end(), name) == read.end()) unused.push_back(name);
  return unused;
}

}  // namespace mote

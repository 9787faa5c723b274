#include "mote/report/chart_json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mote::report {
namespace {

using nlohmann::json;

double rounded(double value, int digits) {
  char text[32];
  const auto written = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  std::from_chars(text, written.ptr, value);
  return value;
}

json numbers(const std::vector<double>& values) {
  const int digits = digits_needed(values);
  json list = json::array();
  list.get_ref<json::array_t&>().reserve(values.size());
  for (const double value : values) list.push_back(std::isfinite(value) ? json(rounded(value, digits)) : json());
  return list;
}

std::string_view name_of(Series::Mark mark) {
  switch (mark) {
    case Series::Mark::kPoints:
      return "points";
    case Series::Mark::kSteps:
      return "steps";
    case Series::Mark::kMarkedLine:
      return "marked";
    case Series::Mark::kLine:
      break;
  }
  return "line";
}

void require_length(std::string_view chart, std::string_view name, std::string_view column, std::size_t expected,
                    std::size_t got) {
  if (expected == got) return;
  throw std::invalid_argument(
      fmt::format("report page: chart \"{}\", \"{}\": expected {} values of {}, one per x, got {}. Give every x its "
                  "value, nan where there is none.",
                  chart, name, expected, column, got));
}

json to_json(const Chart& chart, const Series& series) {
  require_length(chart.title, series.name, "y", series.x.size(), series.y.size());
  json all{{"name", series.name}, {"mark", name_of(series.mark)}, {"x", numbers(series.x)}, {"y", numbers(series.y)}};
  if (series.labels.empty()) return all;
  require_length(chart.title, series.name, "labels", series.x.size(), series.labels.size());
  all["labels"] = series.labels;
  return all;
}

json to_json(const Chart& chart, const Band& band) {
  require_length(chart.title, band.name, "low", band.x.size(), band.low.size());
  require_length(chart.title, band.name, "high", band.x.size(), band.high.size());
  return {{"name", band.name}, {"x", numbers(band.x)}, {"low", numbers(band.low)}, {"high", numbers(band.high)}};
}

json to_json(const Chart& chart, const Bars& bars) {
  require_length(chart.title, bars.name, "end", bars.begin.size(), bars.end.size());
  require_length(chart.title, bars.name, "row", bars.begin.size(), bars.row.size());
  return {{"name", bars.name}, {"begin", numbers(bars.begin)}, {"end", numbers(bars.end)}, {"row", numbers(bars.row)}};
}

template <class Part>
json all_of(const Chart& chart, const std::vector<Part>& parts) {
  json list = json::array();
  for (const Part& part : parts) list.push_back(to_json(chart, part));
  return list;
}

json to_json(const Chart& chart) {
  return {{"title", chart.title},
          {"x_label", chart.x_label},
          {"y_label", chart.y_label},
          {"log_x", chart.log_x},
          {"log_y", chart.log_y},
          {"equal_axes", chart.equal_axes},
          {"rows", chart.rows},
          {"bands", all_of(chart, chart.bands)},
          {"bars", all_of(chart, chart.bars)},
          {"series", all_of(chart, chart.series)}};
}

// Outside its strings JSON has no "<".
std::string without_tags(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

}  // namespace

int digits_needed(std::span<const double> values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double offset = std::log10(std::max(std::abs(low), std::abs(high)) / (high - low));
  return std::isfinite(offset) ? std::clamp(7 + int(std::floor(offset)), 7, 17) : 7;
}

std::string chart_json(std::span<const Chart> charts) {
  json list = json::array();
  for (const Chart& chart : charts) list.push_back(to_json(chart));
  return without_tags(list.dump(-1, ' ', true, json::error_handler_t::replace));
}

}  // namespace mote::report

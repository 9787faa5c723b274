#include "mote/report/chart_json.hpp"

#include <limits>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace mote::report {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

nlohmann::json written(const Chart& chart) { return nlohmann::json::parse(chart_json({&chart, 1})).at(0); }

TEST(ChartJson, CarriesEveryPartOfAChart) {
  const auto json = written({.title = "Level",
                             .x_label = "t",
                             .y_label = "m",
                             .bands = {{"estimate ± 2 sd", {1, 2}, {0, 1}, {2, 3}}},
                             .series = {{"estimate", Series::Mark::kLine, {1, 2}, {1, 2}},
                                        {"observed", Series::Mark::kPoints, {1}, {1.5}},
                                        {"mode", Series::Mark::kSteps, {1}, {0}},
                                        {"study", Series::Mark::kMarkedLine, {1}, {0}}},
                             .log_y = true,
                             .bars = {{"weigh", {0, 2}, {1, 3}, {1, 0}}},
                             .rows = {"a", "b"}});
  EXPECT_EQ(json["title"], "Level");
  EXPECT_EQ(json["bands"][0]["high"], nlohmann::json({2, 3}));
  EXPECT_EQ(json["series"][0]["mark"], "line");
  EXPECT_EQ(json["series"][1]["mark"], "points");
  EXPECT_EQ(json["series"][2]["mark"], "steps");
  EXPECT_EQ(json["series"][3]["mark"], "marked");
  EXPECT_EQ(json["bars"][0]["end"], nlohmann::json({1, 3}));
  EXPECT_EQ(json["bars"][0]["row"], nlohmann::json({1, 0}));
  EXPECT_EQ(json["rows"], nlohmann::json({"a", "b"}));
  EXPECT_EQ(json["log_x"], false);
  EXPECT_EQ(json["log_y"], true);
  EXPECT_EQ(json["equal_axes"], false);
}

TEST(ChartJson, SaysWhatEachPointIs) {
  const auto json = written({.title = "a",
                             .series = {{"a", Series::Mark::kPoints, {1, 2}, {3, 4}, {"mote run ungm", "</b>"}},
                                        {"b", Series::Mark::kPoints, {1}, {2}}}});
  EXPECT_EQ(json["series"][0]["labels"], nlohmann::json({"mote run ungm", "</b>"}));
  EXPECT_FALSE(json["series"][1].contains("labels"));
  const std::vector<Chart> ragged{{.title = "a", .series = {{"a", Series::Mark::kPoints, {1, 2}, {1, 2}, {"b"}}}}};
  EXPECT_THROW(chart_json(ragged), std::invalid_argument);
}

TEST(ChartJson, MakesGapsOfWhatIsNoNumber) {
  const auto json =
      written({.title = "a", .series = {{"a", Series::Mark::kLine, {1, 2, 3, 4}, {kNan, kInfinity, -kInfinity, 4}}}});
  EXPECT_EQ(json["series"][0]["y"].dump(), "[null,null,null,4.0]");
}

TEST(ChartJson, LetsNoNameEndItsElement) {
  const std::string text = chart_json(std::vector<Chart>{{.title = "</script><!-- \" & Ωµ"}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)[0]["title"], "</script><!-- \" & Ωµ");
}

TEST(ChartJson, ReplacesBytesThatAreNoUtf8) { EXPECT_EQ(written({.title = "a\xff z"})["title"], "a\uFFFD z"); }

TEST(ChartJson, WritesSevenDigitsOfTheRange) {
  const auto json = written({.title = "a", .series = {{"a", Series::Mark::kLine, {1.0 / 3, 2}, {1e-30 / 3, 1}}}});
  EXPECT_EQ(json["series"][0]["x"].dump(), "[0.3333333,2.0]");
  EXPECT_EQ(json["series"][0]["y"].dump(), "[3.333333e-31,1.0]");
}

TEST(ChartJson, KeepsStepsOfTimeStampsApart) {
  EXPECT_EQ(digits_needed(std::vector<double>{0, 1}), 7);
  EXPECT_EQ(digits_needed(std::vector<double>{1000, 1001}), 10);
  EXPECT_EQ(digits_needed(std::vector<double>{5, 5, kNan}), 7);
  EXPECT_EQ(digits_needed(std::vector<double>{}), 7);
  const auto json = written({.title = "a", .series = {{"a", Series::Mark::kLine, {1.7e9, 1.7e9 + 0.25}, {0, 0}}}});
  EXPECT_EQ(json["series"][0]["x"][1], 1.7e9 + 0.25);
}

TEST(ChartJson, RefusesColumnsOfDifferentLength) {
  const std::vector<Chart> ragged_series{{.title = "Level", .series = {{"a", Series::Mark::kLine, {1, 2}, {1}}}}};
  const std::vector<Chart> ragged_band{{.title = "Level", .bands = {{"b", {1, 2}, {1, 2}, {1}}}}};
  try {
    chart_json(ragged_series);
    FAIL() << "accepted a series with two x and one y";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "report page: chart \"Level\", \"a\": expected 2 values of y, one per x, got 1. "
                 "Give every x its value, nan where there is none.");
  }
  EXPECT_THROW(chart_json(ragged_band), std::invalid_argument);
  const std::vector<Chart> ragged_bars{{.title = "Level", .bars = {{"b", {1, 2}, {1, 2}, {1}}}}};
  EXPECT_THROW(chart_json(ragged_bars), std::invalid_argument);
}

}  // namespace
}  // namespace mote::report

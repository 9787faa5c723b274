#include "mote/report/run_page.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace mote::report {
namespace {

RunRecord record_of(std::vector<Quantity> states) {
  RunRecord record;
  record.model = "toy";
  record.engine = "reference";
  record.states = std::move(states);
  for (Step t = 1; t <= 3; ++t)
    record.rows.push_back({t, std::vector<Moments>(record.states.size(), {3.0 * (t % 2 == 0 ? -1 : 1), 0.5}), {}, {}});
  return record;
}

std::vector<std::string> titles(const Page& page) {
  std::vector<std::string> all;
  for (const Chart& chart : page.charts) all.push_back(chart.title);
  return all;
}

TEST(RunPage, DrawsATrackForStatesInThePlane) {
  const RunRecord record = record_of({{"x", "m"}, {"y", "m"}});
  const Page page = run_page(record, summarise(record, nullptr), {}, nullptr, "data.csv", "mote run");
  EXPECT_EQ(titles(page),
            (std::vector<std::string>{"Track", "x", "y", "Effective sample size", "Log evidence of each step"}));
  EXPECT_TRUE(page.charts.front().equal_axes);
}

TEST(RunPage, ShowsBandTruthAndDirectObservations) {
  const RunRecord record = record_of({{"level", ""}});
  Recording recording;
  recording.observations = {{.name = "y", .unit = "", .state = "level"}};
  recording.steps.push_back({2, {Row<double>::of({1.5}), Row<double>::of({1.7})}});
  Truth truth{{true}, {{1, {3.0}}, {2, {-2.0}}}};
  const Page page = run_page(record, summarise(record, &truth), recording, &truth, "data.csv", "mote run");
  const Chart& chart = page.charts.front();
  ASSERT_EQ(chart.bands.size(), 1U);
  EXPECT_DOUBLE_EQ(chart.bands[0].low[0], 2.0);
  EXPECT_DOUBLE_EQ(chart.bands[0].high[0], 4.0);
  ASSERT_EQ(chart.series.size(), 3U);
  EXPECT_EQ(chart.series[0].name, "y");
  EXPECT_EQ(chart.series[0].y, (std::vector<double>{1.5, 1.7}));
  EXPECT_EQ(chart.series[2].name, "truth");
  ASSERT_EQ(page.tables.size(), 1U);
  EXPECT_EQ(page.tables[0].rows[0][1], "0.7071");
}

TEST(RunPage, BreaksTheLineOfAnAngleThatWraps) {
  const RunRecord record = record_of({{"theta", "rad", true}});
  const Page page = run_page(record, summarise(record, nullptr), {}, nullptr, "", "");
  const auto& y = page.charts.front().series.front().y;
  EXPECT_EQ(std::count_if(y.begin(), y.end(), [](double v) { return std::isnan(v); }), 2);
}

TEST(RunPage, DrawsTheStagesOfAPipeline) {
  RunRecord record = record_of({{"level", ""}});
  record.stages =
      StageRecord{2,      2.0,
                  0.5,    {{"propose", {{0.5, 3}}, 0, 0}, {"weigh", {{1.5, 2}, {1.0, 1}}, 1.5, 2}, {"chain", {}, 0, 0}},
                  {2, 3}, {{0, 0, 0, 0.1}, {1, 1, 0.1, 0.3}, {3, 0, 0.3, 0.4}}};
  const Page page = run_page(record, summarise(record, nullptr), {}, nullptr, "", "");
  const Chart& chart = page.charts.back();
  EXPECT_EQ(chart.title, "Stages at work, t = 2, 3");
  EXPECT_EQ(chart.rows, (std::vector<std::string>{"propose 1", "weigh 1", "weigh 2", "barrier"}));
  ASSERT_EQ(chart.bars.size(), 3U) << "a stage without workers has no bars";
  EXPECT_EQ(chart.bars[1].begin, (std::vector<double>{100}));
  EXPECT_EQ(chart.bars[1].end, (std::vector<double>{300}));
  EXPECT_EQ(chart.bars[1].row, (std::vector<double>{2}));
  EXPECT_EQ(chart.bars[2].row, (std::vector<double>{3}));
  ASSERT_EQ(page.tables.size(), 1U);
  EXPECT_EQ(page.tables[0].rows[1], (std::vector<std::string>{"weigh 1", "2", "1.5", "0.5", "75 %", "1.5", "2"}));
  EXPECT_NE(page.notes.front().find("2 threads"), std::string::npos);
}

}  // namespace
}  // namespace mote::report

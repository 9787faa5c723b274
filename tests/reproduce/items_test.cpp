// Items: that their comparisons can fail, that their commands make the same numbers, that broken ones are refused.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mote/app/files/table.hpp"
#include "mote/app/reproduce/figures.hpp"
#include "mote/app/reproduce/script.hpp"
#include "mote/base/refusal.hpp"
#include "tests/app/program.hpp"
#include "tests/reproduce/sample_item.hpp"

namespace mote::testing {
namespace {

using reproduce::Item;
using reproduce::Outcome;

Item item_with(const Scratch& scratch, const std::string& text) {
  scratch.write("item.toml", text);
  return reproduce::read_item(scratch.file("item.toml"), "imh-hw");
}

Outcome regenerated(const Item& item) {
  return reproduce::Laboratory(item).regenerate([] {});
}

// claim    the criterion of IMH-HW Fig. 5 tells a right filter from a wrong one
// design   20 repeats of 500 particles on one recording of 30 steps; fixed seeds, so the verdict never flickers
// twin     filters that believe in 1.5 times the measurement error, or in three times the state's noise, must be caught
TEST(Items, AWrongFilterDoesNotHold) {
  const Scratch scratch;
  const auto difference = [&](const std::string& settings) {
    return regenerated(item_with(scratch, sample_item({.run = settings}))).results.front();
  };
  EXPECT_TRUE(difference("").holds) << difference("").ours;
  EXPECT_LT(difference("").ours, 2);
  for (const std::string twin : {"sigma_o=0.3", "sigma_theta=0.06"}) {
    const auto result = difference("set = [\"" + twin + "\"]");
    EXPECT_FALSE(result.holds) << twin << ": " << result.ours;
  }
}

// the shell lines of the page, run as they stand, leave the numbers of the figure bit by bit
TEST(Items, TheirCommandsMakeTheSameNumbers) {
  const Scratch scratch;
  const Item item = item_with(scratch, sample_item({.run = "set = [\"sigma_o=0.3\"]"}));
  const Ended ended = scratch.shell(reproduce::script_for(item));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Table figure = parse_table("figure", reproduce::figure_csv(regenerated(item)));
  for (const std::string run : {"right", "other"}) {
    const Table estimates = read_table(scratch.file("imh-hw-fig-0-" + run + ".csv"));
    ASSERT_EQ(estimates.lines.size(), figure.lines.size());
    for (const std::string column : {"theta_mean", "theta_sd", "phi_mean"})
      for (std::size_t k = 0; k < figure.lines.size(); ++k)
        EXPECT_EQ(estimates.lines[k].fields[estimates.column(column).value()],
                  figure.lines[k].fields[figure.column(fmt::format("{}_{}", run, column)).value()]);
  }
}

// an item that reads the files of a simulation gives what the simulating item gives
TEST(Items, MayReadFilesInsteadOfSimulating) {
  const Scratch scratch;
  const Item simulating = item_with(scratch, sample_item());
  ASSERT_EQ(scratch.shell(reproduce::script_for(simulating)).code, 0);
  std::string text = sample_item();
  const auto from = text.find("[simulate]");
  text.replace(
      from, text.find("set =") - from,
      "[data]\nmodel = \"doa\"\nobservations = \"imh-hw-fig-0-data.csv\"\ntruth = \"imh-hw-fig-0-truth.csv\"\n");
  const Item reading = item_with(scratch, text);
  EXPECT_EQ(reproduce::figure_csv(regenerated(reading)), reproduce::figure_csv(regenerated(simulating)));
  EXPECT_EQ(regenerated(reading).results.front().ours, regenerated(simulating).results.front().ours);
}

TEST(Items, WithoutATruthNoErrorIsCompared) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell(reproduce::script_for(item_with(scratch, sample_item()))).code, 0);
  std::string text = sample_item({.end = "[[compare]]\nname = \"n\"\nkind = \"rmse\"\nruns = [\"right\"]\nstate = "
                                         "\"theta\"\nat_most = 1\n"});
  const auto from = text.find("[simulate]");
  text.replace(from, text.find("set =") - from, "[data]\nmodel = \"doa\"\nobservations = \"imh-hw-fig-0-data.csv\"\n");
  const Item item = item_with(scratch, text);
  try {
    reproduce::Laboratory laboratory(item);
    ADD_FAILURE() << "accepted";
  } catch (const Refusal& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("expected a truth for it"), std::string::npos) << refusal.what();
  }
}

TEST(Items, EveryKindGivesANumber) {
  const Scratch scratch;
  const std::string kinds = R"(
[[compare]]
name = "a"
kind = "rmse"
runs = ["right"]
state = "theta"
at_most = 1
[[compare]]
name = "b"
kind = "normalised-error"
runs = ["right", "other"]
state = "theta"
at_most = 3
[[compare]]
name = "c"
kind = "final-bias"
runs = ["right"]
state = "theta"
over = "median"
at_least = -0.5
at_most = 0.5
[[compare]]
name = "d"
kind = "evidence-spread"
runs = ["right", "other"]
at_most = 5
[[compare]]
name = "e"
kind = "mean-spread"
runs = ["right"]
state = "theta"
at_most = 0.1
[[compare]]
name = "f"
kind = "summary"
key = "acceptance"
runs = ["other"]
paper = 0.5
within = 0.6
)";
  const Outcome outcome = regenerated(item_with(scratch, sample_item({.end = kinds})));
  ASSERT_EQ(outcome.results.size(), 7U);
  for (const auto& result : outcome.results) EXPECT_TRUE(result.holds) << result.asked.name << ": " << result.ours;
  EXPECT_NEAR(outcome.results.back().ratio.value(), outcome.results.back().ours / 0.5, 1e-12);
}

/// Groups of particles on the growth model, compared with what is exact.
std::string groups_item(const std::string& figure = "against = \"bytes_per_step\"\nstate = \"x\"\nrepeats = 3\n") {
  return R"(item = "Fig. 3"
title = "groups"
source = "a test"
printed = "nothing"
[simulate]
model = "ungm"
steps = 20
[[run]]
name = "local"
options = ["--filter", "distributed", "-n", "64", "--groups", "16"]
[[run]]
name = "append"
options = ["--filter", "distributed", "-n", "64", "--groups", "16", "--exchange", "append"]
sweep = "--exchange-count"
values = [1, 4]
[[run]]
name = "global"
options = ["--filter", "distributed", "-n", "64", "--groups", "16", "--group-resampling", "global"]
[[compare]]
name = "recovered"
kind = "recovered"
runs = ["local", "append 1", "global"]
state = "x"
over = "median"
repeats = 3
at_least = 0
[[compare]]
name = "error"
kind = "reference-error"
runs = ["local", "global"]
state = "x"
repeats = 3
at_least = 0
[[compare]]
name = "bytes"
kind = "summary"
key = "bytes_per_step"
runs = ["append 4"]
repeats = 3
at_least = 1024
at_most = 1024
[[figure]]
title = "error"
)" + figure;
}

TEST(GroupItems, CompareWithThePosteriorMean) {
  const Scratch scratch;
  const Item item = item_with(scratch, groups_item());
  ASSERT_EQ(item.runs.size(), 4U);
  EXPECT_EQ(item.runs[2].name, "append 4");
  EXPECT_EQ(item.runs[2].series, "append");
  EXPECT_EQ(item.runs[2].options.back(), "4");
  const Outcome outcome = regenerated(item);
  ASSERT_EQ(outcome.results.size(), 3U);
  const auto& rows = outcome.errors.at("error");
  ASSERT_EQ(rows.size(), 4U);
  // the figure and the comparison have made the same runs: their medians agree
  EXPECT_NEAR(outcome.results[0].ours, (rows[0].error - rows[1].error) / (rows[0].error - rows[3].error), 1e-12);
  EXPECT_TRUE(outcome.results[1].standard_error.has_value());
  EXPECT_TRUE(outcome.results[2].holds) << "16 groups send 4 particles of 8 bytes and their weights: "
                                        << outcome.results[2].ours;
  EXPECT_EQ(rows[0].bytes, 0);
  EXPECT_EQ(rows[1].messages, 16);
  for (const auto& row : rows) EXPECT_TRUE(row.interval.low <= row.error && row.error <= row.interval.high) << row.run;
  const auto chart = reproduce::chart_of(item, item.figures.front(), outcome);
  ASSERT_EQ(chart.series.size(), 3U) << "local across, append as a line, global as a point";
  EXPECT_EQ(chart.series[0].x.size(), 2U);
  EXPECT_EQ(chart.series[1].name, "append");
  EXPECT_EQ(chart.series[1].x, (std::vector<double>{256, 1024}));
  EXPECT_EQ(reproduce::figure_csv(outcome).substr(0, 11), "figure,run,");
}

TEST(GroupItems, AreRefusedByLine) {
  const Scratch scratch;
  const std::vector<std::pair<std::string, std::string>> cases{
      {groups_item("against = \"money\"\nstate = \"x\"\n"), "one of bytes_per_step, messages_per_step, number"},
      {groups_item("against = \"number\"\n"), "\"state\": expected the state whose error is drawn"},
      {groups_item("against = \"number\"\nstate = \"position\"\n"), "\"state\": expected a model with x and y"},
      {groups_item("against = \"number\"\nstate = \"x\"\nruns = [\"no\"]\n"), "names of the item's runs, or of series"},
      {groups_item("state = \"x\"\nrepeats = 3\n"), "\"repeats\": expected"},
  };
  for (const auto& [text, says] : cases) try {
      const Item item = item_with(scratch, text);
      const reproduce::Laboratory laboratory(item);
      ADD_FAILURE() << "accepted: " << says;
    } catch (const Refusal& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(says), std::string::npos) << refusal.what();
    }
  std::string lonely = groups_item();
  lonely.replace(lonely.find("sweep = "), 8, "# ");
  EXPECT_THROW(item_with(scratch, lonely), Refusal);
  std::string two = groups_item();
  two.replace(two.find("\"append 1\", "), 12, "");
  EXPECT_THROW(item_with(scratch, two), Refusal);
}

struct Broken {
  std::string run, compare, says;
};

// the second run's added line is 17 of the sample, its condition line 27
TEST(Items, AreRefusedByLine) {
  const Scratch scratch;
  const std::string fine = "at_most = 3\n";
  const std::vector<Broken> cases{
      {"colour = 3", fine, "item.toml:17: \"colour\": expected one of name, options, set"},
      {"set = [", fine, "item.toml:18"},
      {"set = \"sigma_o=1\"", fine, "item.toml:17: \"set\": expected a list of texts"},
      {"set = [\"sigma=1\"]", fine, "item.toml:14"},
      {"set = [\"sigma_o=-1\"]", fine, "item.toml:14"},
      {"[[run]]\nname = \"Right\"", fine, "item.toml:18: \"name\": expected a name that no other run has"},
      {"[[run]]\nname = \"x\"\noptions = [\"--particels\", \"5\"]", fine, "item.toml:17"},
      {"[[run]]\nname = \"x\"\noptions = [\"-n\", \"0\"]", fine, "item.toml:17: --particles: expected an integer"},
      {"[[run]]\nname = \"x\"\noptions = [\"--proposal\", \"magic\"]", fine, "item.toml:17"},
      {"[[figure]]\ntitle = \"t\"\nstate = \"x\"", fine, "item.toml:17: \"state\": expected a state of the model"},
      {"[[figure]]\ntitle = \"t\"", fine, "item.toml:17: \"state\": expected a model with x and y"},
      {"[[figure]]\ntitle = \"t\"\nstate = \"q\"\nruns = [\"no\"]", fine, "item.toml:20: \"runs\": expected names"},
      {"", "", "item.toml:21: \"at_most\": expected at_least, at_most or within"},
      {"", "within = 0.1\n", "item.toml:27: \"within\": expected a share of a printed number"},
      {"", "at_most = nan\n", "item.toml:27: \"at_most\": expected a finite number, got nan"},
      {"", fine + "repeats = 5\n", "item.toml:28"},
      {"", fine + "paper = true\n", "item.toml:28: \"paper\": expected a text, got true"},
      {"", fine + "unit = \"mile\"\n", "expected one of standard-error, posterior-sd, absolute, got 'mile'"},
      {"", fine + "[[compare]]\nname = \"n\"\nkind = \"magic\"\n", "item.toml:30: \"kind\": expected one of"},
      {"", fine + "[[compare]]\nname = \"n\"\nkind = \"rmse\"\nruns = [\"no\"]\n",
       "item.toml:31: \"runs\": expected names"},
      {"", fine + "[[compare]]\nname = \"n\"\nkind = \"rmse\"\nruns = [\"right\"]\nstate = \"position\"\nat_most = 1\n",
       R"(item.toml:28: "state": expected a state of the model, got "position")"},
  };
  for (const Broken& broken : cases) try {
      const Item item = item_with(scratch, sample_item({.run = broken.run, .compare = broken.compare}));
      const reproduce::Laboratory laboratory(item);
      ADD_FAILURE() << "accepted: " << broken.says;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kBadData) << refusal.what();
      EXPECT_NE(std::string(refusal.what()).find(broken.says), std::string::npos) << refusal.what() << "\n"
                                                                                  << broken.says;
    }
}

}  // namespace
}  // namespace mote::testing

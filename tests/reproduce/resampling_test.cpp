// Resamplers on given weights: the measure against what is known exactly, and the items that ask for it.

#include <gtest/gtest.h>

#include "mote/app/reproduce/figures.hpp"
#include "mote/app/reproduce/script.hpp"
#include "mote/base/refusal.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using reproduce::Item;
using reproduce::Outcome;

TEST(Weights, HaveTheEffectiveSampleSizeAskedFor) {
  for (const double ess : {0.9, 0.5, 0.02}) {
    const auto set = reproduce::weighted_values(500, ess, 3);
    double sum = 0;
    double squares = 0;
    for (const double w : set.weights) sum += w, squares += w * w;
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(1 / squares, ess * 500, 1e-4);
  }
  EXPECT_EQ(reproduce::weighted_values(50, 0.5, 3).values, reproduce::weighted_values(50, 0.5, 3).values);
  EXPECT_NE(reproduce::weighted_values(50, 0.5, 3).values, reproduce::weighted_values(50, 0.5, 4).values);
}

double error_of(const Scheme& scheme) {
  return reproduce::resampled(scheme, reproduce::weighted_values(400, 0.4, 1), 2000, 1).error;
}

/// The twin: draws that flatten the weights.
void flattened(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  std::vector<double> wrong(weights.begin(), weights.end());
  for (double& w : wrong) w = std::pow(w, 0.9);
  multinomial(wrong, draws, ancestors);
}

// claim    the error is in multinomial variances: 1 for independent draws, less for stratified and systematic ones
// referee  the exact variance of multinomial draws
// design   2000 resamplings of 400 particles: the error has a relative standard error of sqrt(2 / 2000) = 0.032
// risk     1 +- 0.16 is 5 of them; the twin, a scheme with a bias, must be caught
TEST(Resampled, ErrorIsInMultinomialVariances) {
  for (const std::string name : {"multinomial", "roulette", "alias"})
    EXPECT_NEAR(error_of(*find_scheme(name)), 1, 0.16);
  EXPECT_LT(error_of(*find_scheme("stratified")), 0.6);
  EXPECT_LT(error_of(systematic_scheme()), 0.6);
  EXPECT_GT(error_of({"flattened", flattened, ""}), 1.16) << "the twin";
}

std::string weights_item(const std::string& weights, const std::string& compare,
                         const std::string& figure = "ess = 0.5") {
  return R"(item = "weights"
title = "two resamplers"
source = "a test"
printed = "nothing"
[weights]
)" + weights +
         R"(
[[run]]
name = "sys"
options = ["--resampler", "systematic"]
[[run]]
name = "multi"
options = ["--resampler", "multinomial"]
[[figure]]
title = "trade-off"
)" + figure +
         R"(
[[compare]]
name = "c"
runs = ["sys", "multi"]
)" + compare;
}

const std::string kWeights = "particles = 200\ness = [0.5, 0.2]";

Item item_with(const Scratch& scratch, const std::string& text) {
  scratch.write("item.toml", text);
  return reproduce::read_item(scratch.file("item.toml"), "ppf");
}

TEST(WeightItems, CompareResamplersAndDrawThem) {
  const Scratch scratch;
  const Item item = item_with(scratch, weights_item(kWeights, R"(kind = "resample-error"
ess = 0.5
at_most = 0.8
[[compare]]
name = "time"
kind = "resample-time"
over = "median"
runs = ["sys"]
ess = 0.5
at_least = 0
[[compare]]
name = "the twin: the other way round"
kind = "resample-error"
runs = ["multi", "sys"]
ess = 0.5
at_most = 0.8
)"));
  reproduce::Laboratory laboratory(item);
  std::size_t ran = 0;
  const Outcome outcome = laboratory.regenerate([&] { ++ran; });
  EXPECT_EQ(ran, laboratory.work());
  ASSERT_EQ(outcome.results.size(), 3U);
  EXPECT_TRUE(outcome.results[0].holds) << outcome.results[0].ours;
  EXPECT_TRUE(outcome.results[0].standard_error.has_value());
  EXPECT_TRUE(outcome.results[1].holds);
  EXPECT_FALSE(outcome.results[2].holds) << outcome.results[2].ours;
  const report::Chart chart = reproduce::chart_of(item, item.figures.front(), outcome);
  ASSERT_EQ(chart.series.size(), 2U);
  EXPECT_EQ(chart.series[1].name, "multi");
  EXPECT_TRUE(chart.log_x && chart.log_y);
  EXPECT_TRUE(reproduce::figure_csv(outcome).starts_with("run,ess,error,ns_per_draw\nsys,0.5,0."));
  EXPECT_EQ(reproduce::script_for(item), "");
}

struct Broken {
  std::string text, says;
};

TEST(WeightItems, AreRefusedByLine) {
  const Scratch scratch;
  const std::string fine = "kind = \"resample-error\"\ness = 0.5\nat_most = 1\n";
  const std::vector<Broken> cases{
      {weights_item("particles = 200", fine), ":5: \"ess\": expected a list of shares of N"},
      {weights_item("ess = [1.0]", fine), ":6: \"ess\": expected a list of shares of N"},
      {weights_item("particles = 1\ness = [0.5]", fine), ":6: \"particles\": expected an integer from 2"},
      {weights_item("ess = [\"much\"]", fine), ":6: \"ess\": expected a list of finite numbers"},
      {weights_item("ess = 0.5", fine), ":6: \"ess\": expected a list of numbers"},
      {weights_item(kWeights + "\nsteps = 5", fine), "\"steps\": expected one of particles, ess, seed"},
      {weights_item(kWeights, "kind = \"rmse\"\ness = 0.5\nat_most = 1\n"),
       "\"kind\": expected one of resample-error, resample-time, resample-cost"},
      {weights_item(kWeights, "ess = 0.5\nat_most = 1\n"), "\"kind\": expected one of resample-error"},
      {weights_item(kWeights, "kind = \"resample-cost\"\ness = 0.3\nat_most = 1\n"),
       "\"ess\": expected one of 0.5, 0.2"},
      {weights_item(kWeights, fine, "state = \"x\""), "\"ess\": expected one of 0.5, 0.2"},
      {weights_item(kWeights, fine) + "[simulate]\nmodel = \"ungm\"\nsteps = 3\n",
       "expected one of the tables [simulate], [data], [weights], [clip], [drawn], [cluster], [design] and [analog]"},
  };
  for (const auto& [text, says] : cases) try {
      reproduce::Laboratory laboratory(item_with(scratch, text));
      ADD_FAILURE() << "accepted: " << says;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kBadData);
      EXPECT_NE(std::string(refusal.what()).find(says), std::string::npos) << refusal.what();
    }
}

}  // namespace
}  // namespace mote::testing

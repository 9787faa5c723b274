// What comparisons compute, against numbers worked out by hand and a law of large numbers.

#include "mote/app/reproduce/statistics.hpp"

#include <gtest/gtest.h>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;
using Unit = Comparison::Unit;

Comparison asking(Kind kind) {
  Comparison c;
  c.kind = kind;
  return c;
}

Samples singles(const std::vector<double>& first, const std::vector<double>& second = {}) {
  Samples samples;
  for (const auto& values : {first, second}) {
    if (values.empty()) continue;
    auto& run = samples.values.emplace_back();
    for (const double v : values) run.push_back({v});
  }
  return samples;
}

TEST(Statistics, MeansMediansAndRatios) {
  Comparison c = asking(Kind::kRmse);
  EXPECT_DOUBLE_EQ(statistic(c, singles({1, 2, 6})), 3);
  EXPECT_DOUBLE_EQ(statistic(c, singles({1, 2, 6}, {2, 2, 2})), 1.5);
  c.median = true;
  EXPECT_DOUBLE_EQ(statistic(c, singles({6, 1, 2})), 2);
  EXPECT_DOUBLE_EQ(statistic(c, singles({6, 1, 2, 4})), 3);
  EXPECT_FALSE(standard_error(c, singles({6, 1, 2})).has_value());
}

// claim    the error of a bearing is that of the direction, wrapped, not of the distance; steps without truth do not
// count
TEST(Statistics, BearingErrors) {
  RunRecord run;
  Truth truth;
  const auto add = [&](Step t, double angle) {
    run.rows.push_back({t, {{3 * std::cos(angle), 0}, {3 * std::sin(angle), 0}}, {}, {}});
  };
  truth.states = {{1, {2 * std::cos(0.5), 2 * std::sin(0.5)}}, {2, {-2, 0}}};
  add(1, 0.6);
  add(2, 0.1 - kPi);
  add(3, 1);
  EXPECT_NEAR(bearing_rmse(run, truth, 0, 1), 0.1, 1e-12);
}

TEST(Statistics, WhatIsRecovered) {
  Comparison c = asking(Kind::kRecovered);
  Samples samples = singles({9, 11}, {4, 6});
  samples.values.push_back({{2}, {2}});
  EXPECT_DOUBLE_EQ(statistic(c, samples), 5.0 / 8) << "(10 - 5) / (10 - 2)";
  EXPECT_FALSE(interval(c, samples).has_value()) << "means have a standard error";
  c.median = true;
  EXPECT_DOUBLE_EQ(statistic(c, samples), 5.0 / 8);
}

// claim    the interval of a median holds the true one about 95 times of 100
// referee  the median of the standard normal law, 0
// design   400 samples of 41 numbers
// risk     1e-6 outside 0.90..0.99 for a coverage of 0.95 (the bootstrap of a median of 41 is that good); the twin (1/2
//          taken for the true median) must be caught
TEST(Statistics, TheIntervalOfAMedianCoversIt) {
  Comparison c = asking(Kind::kReferenceError);
  c.median = true;
  int covered = 0;
  int twin = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    std::vector<double> values;
    Draws{seed, 1}.for_each(Purpose::kTest, 0, 41, [&](std::size_t, auto& draw) { values.push_back(draw.normal()); });
    const auto ends = interval(c, singles(values)).value();
    covered += ends.low <= 0 && 0 <= ends.high ? 1 : 0;
    twin += ends.low <= 0.5 && 0.5 <= ends.high ? 1 : 0;
  }
  EXPECT_GT(covered, 360);
  EXPECT_LT(covered, 396);
  EXPECT_LT(twin, 360);
}

TEST(Statistics, SpreadsAndRoots) {
  EXPECT_DOUBLE_EQ(statistic(asking(Kind::kEvidenceSpread), singles({-1, 1, 3})), 2);
  EXPECT_DOUBLE_EQ(statistic(asking(Kind::kEvidenceSpread), singles({-1, 1, 3}, {0, 1, 2})), 2);
  EXPECT_DOUBLE_EQ(statistic(asking(Kind::kNormalisedError), singles({1, 7})), 2);
  Samples two_times;
  two_times.values = {{{0, 5}, {2, 5}}};  // variances 2 and 0
  EXPECT_DOUBLE_EQ(statistic(asking(Kind::kMeanSpread), two_times), 1);
}

TEST(Statistics, TheLeastNumberOfParticlesThatIsEnoughFromThereOn) {
  Comparison c = asking(Kind::kParticlesEnough);
  c.slack = 0.1;
  Samples samples;
  samples.values = {{{9, 2.1, 5, 1.2, 2}, {9, 2.3, 5, 3.0, 2}}};  // means 9, 2.2, 5, 2.1, 2: 200 particles are chance
  samples.particles = {{100, 200, 400, 800, 1600}};
  EXPECT_DOUBLE_EQ(statistic(c, samples), 800);
  c.slack = 0.04;
  EXPECT_DOUBLE_EQ(statistic(c, samples), 1600);
  c.slack = 4;
  EXPECT_DOUBLE_EQ(statistic(c, samples), 100);
  samples.values.push_back({{3, 1}, {3, 1}});
  samples.particles.push_back({40, 50});
  EXPECT_DOUBLE_EQ(statistic(c, samples), 100.0 / 40);
  EXPECT_FALSE(standard_error(c, samples).has_value());
  samples.values[0][0][4] = kNaN;
  EXPECT_TRUE(std::isnan(statistic(c, samples)));
}

TEST(Statistics, MeanDifferencesInTheirUnits) {
  Samples samples;
  samples.values = {{{0, 3}, {2, 5}}, {{3, 8}, {5, 10}}};  // means 1, 4 against 4, 9; every variance 2
  samples.sds = {{1, 4}, {3, 6}};                          // means 2, 5
  Comparison c = asking(Kind::kMeanDifference);
  c.unit = Unit::kAbsolute;
  EXPECT_DOUBLE_EQ(statistic(c, samples), std::sqrt((9.0 + 25.0) / 2));
  c.unit = Unit::kPosteriorSd;
  EXPECT_DOUBLE_EQ(statistic(c, samples), std::sqrt((2.25 + 1.0) / 2));
  c.unit = Unit::kStandardError;
  EXPECT_DOUBLE_EQ(statistic(c, samples), std::sqrt((9.0 + 25.0) / (4 * 2.0 / 2)));
}

// of a mean, the jackknife's standard error is the textbook's
TEST(Statistics, TheStandardErrorOfAMeanIsTheTextbooks) {
  const double textbook = std::sqrt((9.0 + 1.0 + 4.0 + 4.0) / 3.0 / 4.0);
  EXPECT_NEAR(standard_error(asking(Kind::kRmse), singles({0, 2, 5, 5})).value(), textbook, 1e-12);
  // a ratio that is the same in every repeat is certain
  EXPECT_NEAR(standard_error(asking(Kind::kRmse), singles({2, 4, 6}, {1, 2, 3})).value(), 0, 1e-12);
}

TEST(Statistics, NoNumberStaysNoNumber) {
  EXPECT_TRUE(std::isnan(statistic(asking(Kind::kRmse), singles({1, kNaN}))));
  EXPECT_TRUE(std::isnan(statistic(asking(Kind::kEvidenceSpread), singles({1, -kInfinity}))));
}

}  // namespace
}  // namespace mote::reproduce

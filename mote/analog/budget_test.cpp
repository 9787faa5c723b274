#include "mote/analog/budget.hpp"

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"

namespace mote::analog {
namespace {

using I = Implementation;

TEST(Budget, GivesTableTwoAtBothEnds) {
  EXPECT_NEAR(printed_arctan_power(0.5e-9), 0.361e-6, 0.0005e-6);
  EXPECT_NEAR(printed_arctan_power(20e-9), 14.45e-6, 1e-12);
  EXPECT_NEAR(printed_gaussian_power(0.1e-9), 1.097e-6, 1e-12);
  EXPECT_NEAR(printed_gaussian_power(10e-9), 109.7e-6, 1e-12);
}

TEST(Budget, GivesTableFour) {
  EXPECT_NEAR(cordic_power({}, 12, 1e6), 550e-6, 1e-12);
  EXPECT_NEAR(cordic_power({0.175, 1.65}, 6, 2e6), 550e-6 / 16,
              1e-12);  // half the node and voltage, a quarter of bits^2
  EXPECT_EQ(mcml_power(), 4330e-6);
}

TEST(Budget, GivesTableFiveAsPrinted) {
  const auto rows = table5({});
  const auto check = [&](I i, double microwatt, double macs) {
    const Power power = overall(rows, i, true);
    EXPECT_NEAR(1e6 * power.watt, microwatt, 1e-9) << name_of(i);
    EXPECT_EQ(power.macs, macs) << name_of(i);
  };
  check(I::kMethod1, 1140, 10);
  check(I::kMethod2, 120, 1);
  check(I::kDigital, 1120, 10);
}

TEST(Budget, IsNotMadeOfThePapersRounding) {
  const auto rows = table5({});
  EXPECT_NEAR(1e6 * overall(rows, I::kMethod1, false).watt, 116.925 + 930 + 19.92, 0.01);
  EXPECT_NEAR(1e6 * overall(rows, I::kMethod2, false).watt, 116.925, 0.01);
}

TEST(Budget, SavesWhatThePrintedTableSaves) {
  const auto rows = table5({});
  const Power digital = overall(rows, I::kDigital, true);
  const Power analog = overall(rows, I::kMethod2, true);
  EXPECT_NEAR(saving(digital, analog, 0), 1120.0 / 120, 1e-9);
  EXPECT_NEAR(saving(digital, analog, 1), 10, 1e-3);
  EXPECT_LT(most_mac_for_saving(digital, analog, 20), 0);
}

TEST(Budget, SortsTheEndsOfASaving) {
  const auto [least, most] = saving_range({1120e-6, 10}, {10e-6, 1});  // falls from 112 to 10 as P grows
  EXPECT_NEAR(least, 10, 1e-9);
  EXPECT_NEAR(most, 112, 1e-9);
}

// claim    circuits of a few microwatt are not rounded to no power at all
TEST(Budget, RoundsNothingToZero) {
  Load load;
  load.arctan_w = printed_arctan_power(1e-9);
  load.gaussian_w = printed_gaussian_power(0.1e-9);
  EXPECT_NEAR(1e6 * overall(table5(load), I::kMethod2, true).watt, 0.7225 + 1.097, 1e-9);
}

TEST(Budget, SavesTwentyTimesAtTableThreesCurrentsForSmallMacs) {
  Load load;
  load.gaussian_w = printed_gaussian_power(0.1e-9);
  const Power digital = overall(table5(load), I::kDigital, true);
  const Power analog = overall(table5(load), I::kMethod2, false);
  const double most = most_mac_for_saving(digital, analog, 20);
  EXPECT_NEAR(1e6 * most, 95, 1);
  EXPECT_NEAR(saving(digital, analog, most), 20, 1e-9);
}

TEST(Budget, FollowsTheRateOfParticlesInCopiesAndClocks) {
  const Load load;
  const double one = power_at_rate(load, I::kMethod2, kCircuitRate, 1e-6);
  EXPECT_DOUBLE_EQ(power_at_rate(load, I::kMethod2, 10 * kCircuitRate, 1e-6), 10 * one);
  EXPECT_DOUBLE_EQ(power_at_rate(load, I::kMethod2, 1, 1e-6), one);  // bias flows all the time
  const double digital = power_at_rate(load, I::kDigital, kCircuitRate, 1e-6);
  EXPECT_NEAR(power_at_rate(load, I::kDigital, 10 * kCircuitRate, 1e-6), 10 * digital, 1e-9);
}

// claim    at the circuit's own rate a digital multiply-accumulate takes the 10 P of Table V, whatever that rate is
TEST(Budget, TakesTheMultiplyAccumulateAtTheCircuitsRate) {
  const double mac_w = 5e-6;
  for (const double rate : {1e3, kCircuitRate, 1e6}) {
    Load load;
    load.rate_hz = rate;
    const double without = power_at_rate(load, I::kDigital, rate, 0);
    EXPECT_NEAR(power_at_rate(load, I::kDigital, rate, mac_w) - without, 10 * mac_w, 1e-15) << rate;
  }
}

// claim    what Table V leaves out comes on top: Method-2's ADC and noise sources with each copy, random words with the
//          rate
TEST(Budget, AddsWhatTableFiveLeavesOut) {
  const Load load;
  const auto more = [&](I i, double rate) {
    return whole_power_at_rate(load, i, rate, 1e-6) - power_at_rate(load, i, rate, 1e-6);
  };
  const double one = rate_of_copy(load, I::kMethod2);
  EXPECT_NEAR(more(I::kMethod2, one), 0.18e-3 + 2e-6, 1e-12);
  EXPECT_NEAR(more(I::kMethod2, 8 * one), 8 * (0.18e-3 + 2e-6), 1e-12);
  EXPECT_NEAR(more(I::kMethod1, 8 * one), 8 * random_words_power(2, one), 1e-12);
}

TEST(Budget, CrossesWhereTheCurvesDo) {
  Load load;
  load.gaussian_w = printed_gaussian_power(0.1e-9);
  const double rate = crossover(load, I::kMethod2, I::kDigital, 1e-6);
  const auto ahead = [&](double at) {
    return power_at_rate(load, I::kDigital, at, 1e-6) - power_at_rate(load, I::kMethod2, at, 1e-6);
  };
  EXPECT_GE(ahead(rate), 0);
  EXPECT_LT(ahead(0.9 * rate), 0);
  EXPECT_TRUE(std::isnan(crossover({}, I::kMethod2, I::kDigital, 1e-6)));  // Gaussian at 10 nA
}

}  // namespace
}  // namespace mote::analog

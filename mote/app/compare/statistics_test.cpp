#include "mote/app/compare/statistics.hpp"

#include <gtest/gtest.h>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"

namespace mote::compare {
namespace {

TEST(CompareStatistics, MiddlesOfHandMadeValues) {
  EXPECT_EQ(mean(std::vector<double>{1, 2, 6}), 3);
  EXPECT_EQ(median({6, 1, 2}), 2);
  EXPECT_EQ(median({6, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({1}), 1);
  EXPECT_EQ(median({1, kInfinity, 2}), 2) << "one collapsed run of three";
  EXPECT_EQ(median({1, kInfinity}), kInfinity);
  EXPECT_EQ(median({kInfinity, kInfinity}), kInfinity);
}

TEST(CompareStatistics, DeviationIsWithinGroups) {
  EXPECT_DOUBLE_EQ(pooled_deviation(std::vector<double>{1, 3}, 2), std::sqrt(2));
  EXPECT_DOUBLE_EQ(pooled_deviation(std::vector<double>{1, 3, 101, 103}, 2), std::sqrt(2));
  EXPECT_TRUE(std::isnan(pooled_deviation(std::vector<double>{1, 3}, 1)));
  EXPECT_TRUE(std::isnan(pooled_deviation(std::vector<double>{1, -kInfinity}, 2)));
}

TEST(CompareStatistics, ChiSquareAsInTheTables) {
  EXPECT_NEAR(chi_square_quantile(1, 0.95), 3.841, 1e-3);
  EXPECT_NEAR(chi_square_quantile(4, 0.95), 9.488, 1e-3);
  EXPECT_NEAR(chi_square_band(10).low, 0.3247, 1e-4);
  EXPECT_NEAR(chi_square_band(10).high, 2.0483, 1e-4);
  EXPECT_TRUE(std::isnan(chi_square_band(0).low));
}

/// Log-normal values with an effect of their group: value r of group k is exp(s_k + z_kr).
std::vector<double> skewed(const Sampling& sampling, double group_sd, std::uint32_t data_set) {
  std::vector<double> values;
  auto block = Draws{7, data_set}.block(Purpose::kTest);
  auto draw = block.particle(0);
  for (std::size_t k = 0; k < sampling.groups; ++k) {
    const double effect = group_sd * draw.normal();
    for (std::size_t r = 0; r < sampling.each; ++r) values.push_back(std::exp(effect + draw.normal()));
  }
  return values;
}

/// The share of 600 data sets whose interval of the median holds the true one, 1.
double coverage(const Sampling& sampling, const Sampling& claimed, double group_sd, double level) {
  double held = 0;
  for (std::uint32_t i = 0; i < 600; ++i) {
    const auto values = skewed(sampling, group_sd, i);
    const Interval interval = bootstrap(
        claimed,
        [&](std::span<const std::size_t> places) {
          std::vector<double> drawn;
          for (const std::size_t p : places) drawn.push_back(values[p]);
          return median(std::move(drawn));
        },
        level);
    held += interval.low <= 1 && 1 <= interval.high ? 1 : 0;
  }
  return held / 600;
}

// claim    a 95 % interval holds the true median about 95 times of 100
// referee  the median of log-normal values, 1
// design   600 data sets of 40 values, seeds fixed: from one group, and from 20 groups of 2 with an effect of the group
// risk     the share has a standard error of 0.009; [0.91, 0.99] is 4.5 of them around 0.95. The twins, an interval of
//          80 % and one that takes the values of a group for independent, must be caught
TEST(Bootstrap, HoldsTheTruthAsOftenAsItClaims) {
  for (const double share : {coverage({1, 40}, {1, 40}, 0, 0.95), coverage({20, 2}, {20, 2}, 1, 0.95)}) {
    EXPECT_GT(share, 0.91);
    EXPECT_LT(share, 0.99);
  }
  EXPECT_LT(coverage({1, 40}, {1, 40}, 0, 0.80), 0.91) << "the twin: a shorter interval";
  EXPECT_LT(coverage({4, 10}, {1, 40}, 1, 0.95), 0.91) << "the twin: groups forgotten";
}

TEST(Bootstrap, IsAFunctionOfItsValues) {
  const auto values = skewed({1, 10}, 0, 1);
  const Statistic first = [&](std::span<const std::size_t> places) { return values[places.front()]; };
  const Interval one = bootstrap({1, 10}, first);
  const Interval two = bootstrap({1, 10}, first);
  EXPECT_EQ(one.low, two.low);
  EXPECT_EQ(one.high, two.high);
}

TEST(Bootstrap, HasNoIntervalForOneValueOrNone) {
  EXPECT_TRUE(std::isnan(bootstrap({1, 1}, [](auto) { return 1.0; }).low));
  EXPECT_TRUE(std::isnan(bootstrap({1, 5}, [](auto) { return kNaN; }).high));
}

TEST(Bootstrap, LeavesALevelOfOneAlone) {
  bootstrap({1, 6}, [](std::span<const std::size_t> places) {
    EXPECT_EQ(places.size(), 6U);
    for (const std::size_t p : places) EXPECT_LT(p, 6U);
    return 0.0;
  });
  bootstrap({3, 2}, [](std::span<const std::size_t> places) {
    EXPECT_EQ(places.size(), 6U);
    for (std::size_t i = 0; i < 6; i += 2) EXPECT_EQ(places[i] / 2, places[i + 1] / 2) << "both of one group";
    return 0.0;
  });
}

}  // namespace
}  // namespace mote::compare

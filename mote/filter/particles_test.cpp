#include "mote/filter/particles.hpp"

#include <gtest/gtest.h>

#include "mote/filter/settle.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

std::vector<double> component(const Particles<double>& x, std::size_t d) {
  return {x.component(d).begin(), x.component(d).end()};
}

Particles<double> counted(std::size_t n) {
  Particles<double> x(2, n);
  for (std::size_t i = 0; i < n; ++i)
    x.write(i, std::array<double, 2>{static_cast<double>(i), -static_cast<double>(i)});
  return x;
}

TEST(Particles, ReadWhatWasWritten) {
  const auto x = counted(4);
  std::array<double, 2> state{};
  x.read(3, state);
  EXPECT_EQ(state, (std::array<double, 2>{3, -3}));
  EXPECT_EQ(x.size(), 4U);
  EXPECT_EQ(x.dimensions(), 2U);
}

TEST(Particles, GatherFromASourceAndInPlace) {
  const std::vector<Index> ancestors{3, 3, 0};
  Particles<double> picked(2, 3);
  picked.gather(counted(4), ancestors);
  EXPECT_EQ(component(picked, 0), (std::vector<double>{3, 3, 0}));
  EXPECT_EQ(component(picked, 1), (std::vector<double>{-3, -3, 0}));
  auto x = counted(4);
  x.gather(ancestors, 1);  // in place, from the old values even where they are overwritten
  EXPECT_EQ(component(x, 0), (std::vector<double>{0, 3, 3, 0}));
}

TEST(Particles, KeepTheirValuesWhenResized) {
  auto x = counted(3);
  x.resize(5);
  EXPECT_EQ(x.size(), 5U);
  EXPECT_EQ(x.component(1)[2], -2);
  x.resize(2);
  EXPECT_EQ(component(x, 0), (std::vector<double>{0, 1}));
}

TEST(Weigh, UnusableDensitiesAreZero) {
  EXPECT_EQ(usable(kNaN), -kInfinity);
  EXPECT_EQ(usable(kInfinity), -kInfinity);
  EXPECT_EQ(usable(-3.5), -3.5);
}

TEST(Weigh, RowsMultiplyAndNaNCountsAsZero) {
  const Ungm<1> model;
  Particles<double> x(1, 3);
  x.write(0, std::array<double, 1>{2});
  x.write(1, std::array<double, 1>{kNaN});
  x.write(2, std::array<double, 1>{-2});
  const std::vector<Row<double>> rows{Row<double>::of({1}), Row<double>::of({-0.5})};
  std::vector<double> log_weights{1, 1, 1};
  weigh<Ungm<1>, double>(model, 1, rows, x, log_weights);
  EXPECT_DOUBLE_EQ(log_weights[0], 1 + normal_log_density(0.8, 1.0) + normal_log_density(-0.7, 1.0));
  EXPECT_EQ(log_weights[1], -kInfinity);
  EXPECT_EQ(log_weights[2], log_weights[0]);
}

TEST(Normalise, LeavesLogSumZeroAndSaysWhatItWas) {
  for (const std::size_t groups : {1, 2, 3}) {
    Cloud<double> cloud(1, std::make_shared<Membership>(Groups(3, groups)));
    cloud.log_weights = {-1000, -1000 + std::log(3.0), -kInfinity};
    const Judgement j = normalise(cloud);
    EXPECT_FALSE(j.collapsed);
    EXPECT_NEAR(j.log_sum, -1000 + std::log(4.0), 1e-12);
    EXPECT_NEAR(cloud.log_weights[1], std::log(0.75), 1e-12);
    EXPECT_EQ(cloud.weights[1], 1);
    EXPECT_EQ(cloud.weights[2], 0);
    EXPECT_NEAR(j.total, 4.0 / 3, 1e-12);
    EXPECT_NEAR(j.ess, 16.0 / 10, 1e-12);
  }
}

TEST(Normalise, TellsACollapseAndTouchesNothing) {
  Cloud<double> cloud(1, 3);
  cloud.log_weights.assign(3, -kInfinity);
  cloud.weights = {1, 2, 3};
  EXPECT_TRUE(normalise(cloud).collapsed);
  EXPECT_EQ(cloud.weights, (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace mote

#include "mote/referee/solver.hpp"

#include <gtest/gtest.h>

#include "mote/model/bearings.hpp"
#include "mote/referee/grid.hpp"

namespace mote::referee {
namespace {

/// A recording of one column.
Recording recording_of(const std::vector<double>& values) {
  Recording recording{{{"y", ""}}, {}};
  Step t = 0;
  for (const double y : values) recording.steps.push_back({++t, {Row<double>::of({y})}});
  return recording;
}

const std::vector<double> kGrowth{1.2, 0.3, 5.1, 12.0, 3.3, 0.1, 7.7, 9.9};

TEST(Solver, IsNoneWhereNoneIsKnown) {
  EXPECT_EQ(solver_of(Bearings{}), nullptr);
  EXPECT_EQ(solver_of(Ungm<1>{{.q = 0}}), nullptr) << "no grid resolves a state without noise";
  EXPECT_EQ(solver_of(Ungm<1>{{.q = 1e-6}}), nullptr);
}

// One step by hand: x_1 ~ N(1120, 1e5 + 1469.1), y = 1000 with variance 15099.
TEST(Solver, OfTheLocalLevelIsTheKalmanFilter) {
  const auto solver = solver_of(LocalLevel{});
  const auto solution = solver->solve(recording_of({1000}));
  ASSERT_TRUE(solution);
  const double before = 1e5 + 1469.1;
  EXPECT_NEAR(solution->means[0][0], 1120 - 120 * before / (before + 15099), 1e-9);
  EXPECT_NEAR(solution->log_evidence, normal_log_density(120.0, before + 15099), 1e-9);
  EXPECT_EQ(solver->name(), "Kalman filter");
}

TEST(Solver, OfTheGrowthModelAgreesWithAFinerGrid) {
  const Ungm<1> model{{.a = 0.5, .omega = 1.2, .q = 3, .r = 0.3, .p0 = 0.02}};
  const auto solution = solver_of(model)->solve(recording_of(kGrowth));
  ASSERT_TRUE(solution);
  const GridResult fine = Grid(model, 50, 8001).filter(recording_of(kGrowth));
  for (std::size_t k = 0; k < kGrowth.size(); ++k) EXPECT_NEAR(solution->means[k][0], fine.means[k], 1e-5);
  EXPECT_NEAR(solution->log_evidence, fine.log_evidence, 1e-5);
}

TEST(Solver, OfTwoCopiesSolvesEachByItself) {
  Recording both{{{"y1", ""}, {"y2", ""}}, {}};
  for (std::size_t k = 0; k < kGrowth.size(); ++k)
    both.steps.push_back({static_cast<Step>(k) + 1, {{{kGrowth[k], kNaN}, {true, false}}}});
  const auto one = solver_of(Ungm<1>{})->solve(recording_of(kGrowth));
  const auto two = solver_of(Ungm<2>{})->solve(both);
  ASSERT_TRUE(one && two);
  for (std::size_t k = 0; k < kGrowth.size(); ++k) {
    ASSERT_EQ(two->means[k].size(), 2U);
    EXPECT_EQ(two->means[k][0], one->means[k][0]);
  }
  EXPECT_NEAR(two->log_evidence, one->log_evidence, 1e-6) << "an unseen copy has no evidence";
}

TEST(Solver, WidensItsGridForAStateThatLeavesIt) {
  const Ungm<1> walk{{.a = 1, .omega = 2, .q = 10, .r = 1, .p0 = 5}};
  std::vector<double> climbing;  // x = 6, 12, ... 66
  for (int k = 1; k <= 11; ++k) climbing.push_back(36.0 * k * k / 20);
  EXPECT_GT(Grid(walk).filter(recording_of(climbing)).outside, 1e-6);
  const auto solution = solver_of(walk)->solve(recording_of(climbing));
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->means.back()[0], Grid(walk, 300, 6001).filter(recording_of(climbing)).means.back(), 1e-4);
  EXPECT_FALSE(solver_of(walk)->solve(recording_of({1, 1e9}))) << "no grid reaches x = 141421";
}

}  // namespace
}  // namespace mote::referee

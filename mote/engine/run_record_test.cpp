#include "mote/engine/run_record.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

/// A record of states x, y and an angle, one row a step, with the given means.
RunRecord record_of(const std::vector<std::vector<double>>& means) {
  RunRecord record;
  record.states = {{"x", "m"}, {"y", "m"}, {"theta", "rad", true}};
  record.plan.particles = 10;
  for (const auto& row : means) {
    EstimateRow estimate{static_cast<Step>(record.rows.size() + 1), {}, {}, {}};
    for (const double m : row) estimate.states.push_back({m, 1});
    record.rows.push_back(estimate);
  }
  return record;
}
Truth truth_of(const std::vector<std::vector<double>>& states) {
  Truth truth{{true, true, true}, {}};
  for (const auto& row : states) truth.states[static_cast<Step>(truth.states.size() + 1)] = row;
  return truth;
}

TEST(Summary, ScoresAnglesByTheirWrappedDifference) {
  const auto record = record_of({{0, 0, 3.1}, {0, 0, -3.1}});
  const auto truth = truth_of({{0, 0, -3.1}, {0, 0, 3.1}});
  EXPECT_NEAR(summarise(record, &truth).rmse[2], 2 * kPi - 6.2, 1e-12);
}

TEST(Summary, PositionErrorIsOfDistances) {
  const auto record = record_of({{3, 4, 0}, {0, 1, 0}, {0, 0, 0}});
  const auto truth = truth_of({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  const Summary s = summarise(record, &truth);
  ASSERT_TRUE(s.position_error);
  EXPECT_DOUBLE_EQ(s.position_error->mean, 2);
  EXPECT_DOUBLE_EQ(s.position_error->median, 1);
  EXPECT_DOUBLE_EQ(s.position_error->rmse, std::sqrt(26.0 / 3));
  EXPECT_DOUBLE_EQ(s.rmse[0], std::sqrt(3.0));
}

TEST(Summary, TheMedianOfAnEvenNumberIsBetween) {
  const auto record = record_of({{1, 0, 0}, {2, 0, 0}});
  const auto truth = truth_of({{0, 0, 0}, {0, 0, 0}});
  EXPECT_DOUBLE_EQ(summarise(record, &truth).position_error->median, 1.5);
}

TEST(Summary, UnknownTruthDoesNotScore) {
  const auto record = record_of({{1, 1, 0}, {2, 7, 0}, {3, 3, 0}});
  Truth truth = truth_of({{0, 0, 0}, {0, kNaN, 0}});  // the second y and all of step 3 are unknown
  EXPECT_DOUBLE_EQ(summarise(record, &truth).rmse[1], 1);
  EXPECT_DOUBLE_EQ(summarise(record, &truth).rmse[0], std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(summarise(record, &truth).position_error->mean, std::sqrt(2.0));
  truth.known = {true, false, true};
  EXPECT_TRUE(std::isnan(summarise(record, &truth).rmse[1]));
  EXPECT_FALSE(summarise(record, &truth).position_error);
}

TEST(Summary, TrafficIsAMeanOverTheSteps) {
  auto record = record_of({{1, 1, 0}, {2, 2, 0}});
  record.plan.filter = FilterKind::kDistributed;
  record.rows[1].report.traffic = {3, 50};
  EXPECT_EQ(summarise(record, nullptr).traffic_per_step.messages, 1.5);
  EXPECT_EQ(summarise(record, nullptr).traffic_per_step.bytes, 25);
}

TEST(Summary, ChainsShareTheirParents) {
  auto record = record_of({{1, 1, 0}});
  record.plan.filter = FilterKind::kImh;
  record.plan.particles = 1024;
  EXPECT_EQ(summarise(record, nullptr).traffic_per_step.bytes, 0) << "one chain";
  record.plan.chain.chains = 16;
  EXPECT_EQ(summarise(record, nullptr).traffic_per_step.messages, 64);
  EXPECT_EQ(summarise(record, nullptr).traffic_per_step.bytes, 15 * 1024 * 3 * 8);
}

TEST(Summary, WithoutTruthThereIsNoScore) {
  const auto record = record_of({{1, 1, 0}});
  EXPECT_TRUE(summarise(record, nullptr).rmse.empty());
  EXPECT_FALSE(summarise(record, nullptr).position_error);
}

TEST(Summary, SumsReportsUp) {
  auto record = record_of({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  record.rows[0].report = {-1.5, 10, 0.5, 4, true, false};
  record.rows[1].report = {0, 6, kNaN, 0, false, false};  // a step without observation
  record.rows[2].report = {-2, 8, 0.25, 2, true, false};
  record.predicted_steps = 5;
  record.step_seconds = 1e-6;
  const Summary s = summarise(record, nullptr);
  EXPECT_DOUBLE_EQ(s.log_evidence, -3.5);
  EXPECT_DOUBLE_EQ(s.mean_ess, 8);
  EXPECT_DOUBLE_EQ(s.acceptance, 0.375);
  EXPECT_DOUBLE_EQ(s.mean_burn_in, 3);
  EXPECT_EQ(s.collapses, 0U);
  EXPECT_DOUBLE_EQ(s.ns_per_particle_step, 1000 / 50.0);
  record.rows[2].report.collapsed = true;
  record.rows[2].report.log_evidence = -kInfinity;
  EXPECT_EQ(summarise(record, nullptr).collapses, 1U);
  EXPECT_EQ(summarise(record, nullptr).log_evidence, -kInfinity);
}

TEST(Summary, OfNothingIsNotANumber) {
  const Summary s = summarise(record_of({}), nullptr);
  EXPECT_EQ(s.log_evidence, 0);
  EXPECT_TRUE(std::isnan(s.mean_ess));
  EXPECT_TRUE(std::isnan(s.ns_per_particle_step));
}

}  // namespace
}  // namespace mote

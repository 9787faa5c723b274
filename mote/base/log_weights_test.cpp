#include "mote/base/log_weights.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

TEST(LogSumExp, AgreesWithTheDefinition) {
  const std::vector<double> logs{std::log(0.1), std::log(0.2), -kInfinity, std::log(0.7)};
  EXPECT_NEAR(log_sum_exp(logs).log_sum, 0.0, 1e-15);
  EXPECT_EQ(log_sum_exp(logs).largest, std::log(0.7));
}

TEST(LogSumExp, SurvivesWhereLinearWeightsUnderflow) {
  const std::vector<double> logs(10, -1e6);
  EXPECT_NEAR(log_sum_exp(logs).log_sum, -1e6 + std::log(10.0), 1e-9);
}

TEST(LogSumExp, SaysWhenAllIsZero) { EXPECT_EQ(log_sum_exp(std::vector<double>(4, -kInfinity)).log_sum, -kInfinity); }

TEST(EffectiveSampleSize, KnowsItsEnds) {
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>(50, 0.3)), 50);
  EXPECT_DOUBLE_EQ(effective_sample_size(std::vector<double>{0, 5, 0}), 1);
  EXPECT_EQ(effective_sample_size(std::vector<double>{0, 0}), 0);
}

}  // namespace
}  // namespace mote

#include "mote/base/refusal.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

TEST(Refusal, StatesFiveFactsInOrder) {
  const Refusal refusal(ExitCode::kWrongUse,
                        {"mote run", "--particles", "an integer from 1 to 268435456", "0", "Pass --particles 1000."});
  EXPECT_STREQ(refusal.what(),
               "mote run: --particles: expected an integer from 1 to 268435456, got 0. Pass --particles 1000.");
  EXPECT_EQ(refusal.code(), ExitCode::kWrongUse);
}

TEST(Refusal, LeavesOutEmptyFacts) {
  EXPECT_STREQ(Refusal(ExitCode::kBadData, RefusalText{"obs.csv:17", "", "a number", "", ""}).what(),
               "obs.csv:17: expected a number.");
}

}  // namespace
}  // namespace mote

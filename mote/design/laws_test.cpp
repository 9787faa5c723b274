#include "mote/design/laws.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace mote::design {
namespace {

const LawCheck& found(const std::vector<LawCheck>& all, const std::string& law) {
  const auto named = [&](const LawCheck& check) { return check.law == law; };
  return *std::find_if(all.begin(), all.end(), named);
}

// T_p = 2, T_w = 5, T_d = 1 and four proposals, worked by hand: proposed at 2, 4, 6, 8; by two weighers done at 7, 9,
// 12, 14, the chain at 8, 10, 13, 15.
TEST(Laws, OfFourProposalsByHand) {
  Demand d;
  d.times = {2, 5, 1};
  d.kept = 4;
  const auto all = check_laws(d, 1, 2, 2);
  EXPECT_DOUBLE_EQ(found(all, "L1").time, 3 * 5 + 2 + 5 + 1);
  EXPECT_DOUBLE_EQ(found(all, "L1").exact_time, 23);
  EXPECT_DOUBLE_EQ(found(all, "L2").exact_time, 2 + 5 + 4);
  EXPECT_DOUBLE_EQ(found(all, "L3").exact_time, 23) << "one pair";
  EXPECT_DOUBLE_EQ(found(all, "L6").exact_time, 15);
  EXPECT_DOUBLE_EQ(found(all, "L6").time, 2 * 2 + 4 * 5 / 2.0 + 2);
  EXPECT_NEAR(found(all, "L6").error(), 1.0 / 15, 1e-12);
  EXPECT_DOUBLE_EQ(found(all, "L4").exact_time, 10) << "two copies, each of two proposals";
  EXPECT_DOUBLE_EQ(found(all, "L9").exact_time, 14 + 4);
}

bool exact(double error) { return std::abs(error) < 1e-12; }

// claim    one after the other and without bounds the laws are exact; the others err by what fills and drains a line
// referee  the schedule in closed form
TEST(Laws, AreExactWhereNothingOverlapsInParts) {
  const auto all = survey_laws(1000, 1);
  ASSERT_EQ(all.size(), 9U);
  for (const LawErrors& law : all) {
    if (law.law == "L1" || law.law == "L2") {
      EXPECT_TRUE(exact(law.least) && exact(law.most)) << law.law;
    }
    EXPECT_LT(std::abs(law.median), 0.02) << law.law;
    EXPECT_GT(law.demands, 30U) << law.law;
    EXPECT_LE(law.usual, std::max(-law.least, law.most));
  }
}

// twin of the above: laws that forget burn-in, against the same schedules, are called exact nowhere
TEST(LawsTwin, LawsThatForgetBurnInAreCaught) {
  for (std::size_t burn_in = 1; burn_in < 100; ++burn_in) {
    Demand d;
    d.times = {2, 5, 1};
    d.kept = 1000;
    const auto forgetful = check_laws(d, 1, 1, 1);
    d.burn_in = burn_in;
    const auto whole = check_laws(d, 1, 1, 1);
    for (const char* law : {"L1", "L2"}) {
      EXPECT_TRUE(exact(found(whole, law).error())) << law;
      const LawCheck forgets{law, found(forgetful, law).time, found(whole, law).exact_time};
      EXPECT_FALSE(exact(forgets.error())) << law;
    }
  }
}

}  // namespace
}  // namespace mote::design

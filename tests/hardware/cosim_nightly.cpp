#include "tests/hardware/cosim.hpp"

namespace mote::hardware {
namespace {

// claim    see cosim.hpp; 10^6 rows of every pipeline, with DSP blocks and tables
TEST(DatapathCircuitsNightly, EqualTheirTwins) {
  EXPECT_GE(expect_equal_to_circuits(subjects(), 250, 4000), 20'000'000U);
}

// claim    the same of circuits of logic alone and of CORDIC
TEST(DatapathCircuitsNightly, EqualTheirTwinsInLogicAndCordic) {
  EXPECT_GE(expect_equal_to_circuits(subjects({.multiplier = Multiplier::kLogic, .form = Form::kCordic}), 25, 4000),
            2'000'000U);
}

// claim    the same where costly operators take turns: 10^6 rows of every pipeline together
TEST(DatapathCircuitsNightly, EqualTheirTwinsWhereOperatorsTakeTurns) {
  EXPECT_GE(expect_equal_to_circuits(subjects({.interval = 2}), 30, 4000), 1'000'000U);
  EXPECT_GE(expect_equal_to_circuits(subjects({.multiplier = Multiplier::kLogic, .interval = 4}), 10, 4000), 500'000U);
}

}  // namespace
}  // namespace mote::hardware

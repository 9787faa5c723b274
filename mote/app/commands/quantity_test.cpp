#include "mote/app/commands/quantity.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

double seconds(const std::string& text) {
  return quantity_from(Arguments("mote design explore", "", {{"--deadline", {text}}}, {}), "--deadline", kTimes, "1ms");
}

TEST(Quantity, IsANumberWithItsUnit) {
  EXPECT_DOUBLE_EQ(seconds("1ms"), 1e-3);
  EXPECT_DOUBLE_EQ(seconds(" 2.5 us "), 2.5e-6);
  EXPECT_DOUBLE_EQ(seconds("1e3ns"), 1e-6);
  EXPECT_DOUBLE_EQ(seconds("2s"), 2);
}

TEST(Quantity, RefusesEverythingElseInOneSentence) {
  for (const char* text : {"1", "ms", "1 parsec", "-1ms", "0s", "nan s", "inf s", "1ms2", "1e400s", "1m", ""}) {
    try {
      seconds(text);
      ADD_FAILURE() << text;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kWrongUse);
      EXPECT_NE(std::string(refusal.what())
                    .find("mote design explore: --deadline: expected a number above 0 with its "
                          "unit (ms, us, ns, s), got \""),
                std::string::npos)
          << refusal.what();
    }
  }
}

TEST(Quantity, IsShownInTheUnitThatFits) {
  EXPECT_EQ(in_units(2), "2 s");
  EXPECT_EQ(in_units(1e-3), "1 ms");
  EXPECT_EQ(in_units(1.2345e-4), "123 us");
  EXPECT_EQ(in_units(9.996e-4), "1 ms");
  EXPECT_EQ(in_units(9.99e-4), "999 us");
  EXPECT_EQ(in_units(5e-8), "50 ns");
  EXPECT_EQ(in_units(0), "0 ns");
}

}  // namespace
}  // namespace mote

#include "mote/app/terminal/progress.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

TEST(ProgressLine, TellsShareRateAndTimeLeft) {
  EXPECT_EQ(progress_line(250, 1000, 5, "steps", 80),
            "[######..................]  25 %  250/1000 steps  50/s  15 s left");
  EXPECT_EQ(progress_line(3, 3, 1, "items", 80), "[########################] 100 %  3/3 items  3/s  0 s left");
}

TEST(ProgressLine, TellsLongTimesInLargerUnits) {
  EXPECT_NE(progress_line(1, 1001, 1, "steps", 80).find("17 min left"), std::string::npos);
  EXPECT_NE(progress_line(1, 36001, 1, "steps", 80).find("10 h left"), std::string::npos);
}

TEST(ProgressLine, KeepsWithinItsColumns) {
  for (std::size_t columns = 0; columns <= 80; ++columns)
    EXPECT_LE(progress_line(9'999'999, 10'000'000, 12345.6, "steps", columns).size(), columns);
  EXPECT_NE(progress_line(1, 10'000'000, 12345.6, "steps", 79).find(" h left"), std::string::npos)
      << "the longest line that there can be fits as a whole";
}

}  // namespace
}  // namespace mote

#include "mote/hardware/format.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace mote::hardware {
namespace {

TEST(Format, KnowsItsLimits) {
  constexpr Format kSigned{true, 3, 4};
  EXPECT_EQ(kSigned.width(), 8);
  EXPECT_EQ(kSigned.greatest(), 127);
  EXPECT_EQ(kSigned.least(), -128);
  EXPECT_EQ(kSigned.name(), "s3.4");
  constexpr Format kSmall{false, -3, 11};
  EXPECT_EQ(kSmall.width(), 8);
  EXPECT_EQ(kSmall.least(), 0);
  EXPECT_DOUBLE_EQ(kSmall.value(kSmall.greatest()), 0.125 - 0x1p-11);
}

TEST(Format, TakesTheNearestWord) {
  constexpr Format kFormat{true, 3, 4};
  EXPECT_EQ(kFormat.nearest(1.03), 16);
  EXPECT_EQ(kFormat.nearest(-1.04), -17);
  EXPECT_EQ(kFormat.nearest(1e300), 127);
  EXPECT_EQ(kFormat.nearest(-std::numeric_limits<double>::infinity()), -128);
  EXPECT_EQ(kFormat.nearest(std::nan("")), 0);
}

// referee  floor() in double, exact for these sizes
TEST(Resized, RoundsSaturatesAndWrapsAsStated) {
  constexpr Format kTo{true, 2, 1};
  for (Word word = -200; word <= 200; ++word) {
    const double halves = static_cast<double>(word) / 8;  // fraction 4 to fraction 1
    EXPECT_EQ(resized(word, 4, kTo, {Rounding::kDown, Overflow::kSaturate}),
              std::clamp<Word>(static_cast<Word>(std::floor(halves)), -8, 7));
    EXPECT_EQ(resized(word, 4, kTo, {Rounding::kNearest, Overflow::kSaturate}),
              std::clamp<Word>(static_cast<Word>(std::floor(halves + 0.5)), -8, 7));
    const Word wrapped = resized(word, 4, kTo, {Rounding::kDown, Overflow::kWrap});
    EXPECT_EQ((wrapped - static_cast<Word>(std::floor(halves))) % 16, 0);
    EXPECT_TRUE(wrapped >= -8 && wrapped <= 7);
  }
  EXPECT_EQ(resized(-5, 0, {false, 4, 0}), 0);
  EXPECT_EQ(resized(-1, 0, {false, 4, 0}, {Rounding::kDown, Overflow::kWrap}), 15);
}

}  // namespace
}  // namespace mote::hardware

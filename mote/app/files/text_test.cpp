#include "mote/app/files/text.hpp"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

TEST(NumberIn, TakesWholeNumbersOnly) {
  EXPECT_EQ(number_in("1.5"), 1.5);
  EXPECT_EQ(number_in("+1e3"), 1000);
  EXPECT_EQ(number_in("-.5"), -0.5);
  for (const std::string text : {"", "+", "-", "1.5x", " 1", "1 ", "0x10", "1,5", "--1", "+-1x", "e3"})
    EXPECT_FALSE(number_in(text)) << text;
}

TEST(NumberIn, KnowsWhatHasNoPlaceInADouble) {
  EXPECT_EQ(number_in("1e-400"), 0);
  EXPECT_EQ(number_in("1e400"), HUGE_VAL);
  EXPECT_EQ(number_in("-1e400"), -HUGE_VAL);
  EXPECT_TRUE(std::isnan(*number_in("nan")));
  EXPECT_FALSE(number_in("1e400x"));
}

TEST(IntegerIn, TakesWholeIntegersOnly) {
  EXPECT_EQ(integer_in("9223372036854775807"), 9223372036854775807LL);
  EXPECT_EQ(integer_in("+7"), 7);
  EXPECT_EQ(integer_in("-7"), -7);
  for (const std::string text : {"", "1e3", "1.0", "9223372036854775808", "0x1", " 1", "abc"})
    EXPECT_FALSE(integer_in(text)) << text;
}

TEST(Trimmed, LeavesWhatIsBetweenBlanks) {
  EXPECT_EQ(trimmed(" \t a b\r"), "a b");
  EXPECT_EQ(trimmed(" \r\t"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(InQuotes, ShowsNoControlCharacterAndNoEnd) {
  EXPECT_EQ(in_quotes("a\x1b[31m\n"), "\"a?[31m?\"");
  EXPECT_EQ(in_quotes(std::string(61, 'x')), "\"" + std::string(60, 'x') + "...\"");
  EXPECT_EQ(printable("caf\xc3\xa9\x7f"), "caf\xc3\xa9?");
}

TEST(RefuseOtherThanAscii, NamesTheLine) {
  EXPECT_NO_THROW(refuse_other_than_ascii("m.toml", "a = 1\n"));
  try {
    refuse_other_than_ascii("m.toml", "a = 1\n\nb = '\xc3\xa9'\n");
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_TRUE(std::string(refusal.what()).starts_with("m.toml:3: expected plain ASCII text"));
  }
}

TEST(ReadText, RefusesAFolder) { EXPECT_THROW(read_text(std::filesystem::temp_directory_path().string()), Refusal); }

}  // namespace
}  // namespace mote

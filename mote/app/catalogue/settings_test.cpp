#include "mote/app/catalogue/settings.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

Settings settings(const std::vector<std::string>& texts) { return {"mote run", texts}; }

TEST(Settings, GiveNumbersOrTheirFallback) {
  const Settings given = settings({"q=2.5", "r=+1", "n=2", "file=a=b.toml"});
  EXPECT_EQ(given.number("q", 10), 2.5);
  EXPECT_EQ(given.number("r", 10, Range::kPositive), 1);
  EXPECT_EQ(given.number("p", 10), 10);
  EXPECT_EQ(given.integer("n", 1, 1, 2), 2);
  EXPECT_EQ(given.text("file"), "a=b.toml") << "only the first = divides";
  EXPECT_NO_THROW(given.finish("ungm", {"q", "r", "p", "n", "file"}));
}

TEST(Settings, RefuseWhatIsOutOfRange) {
  for (const std::string bad : {"", "x", "1x", "nan", "inf", "1e999", "-1", "0"})
    EXPECT_THROW(settings({"q=" + bad}).number("q", 1, Range::kPositive), Refusal) << bad;
  EXPECT_EQ(settings({"q=0"}).number("q", 1, Range::kNotNegative), 0);
  EXPECT_EQ(settings({"q=-1"}).number("q", 1), -1);
  for (const std::string bad : {"-0.1", "1", "2"})
    EXPECT_THROW(settings({"q=" + bad}).number("q", 0, Range::kFraction), Refusal) << bad;
  EXPECT_EQ(settings({"q=0"}).number("q", 0.5, Range::kFraction), 0);
  for (const std::string bad : {"", "0", "3", "1.5", "1e0"})
    EXPECT_THROW(settings({"n=" + bad}).integer("n", 1, 1, 2), Refusal) << bad;
}

TEST(Settings, RefuseWhatIsNoSetting) {
  for (const std::string bad : {"", "q", "=3", "="}) EXPECT_THROW(settings({bad}), Refusal) << bad;
  EXPECT_THROW(settings({"q=1", "q=1"}), Refusal);
}

TEST(Settings, RefuseLeftoversByTheNearestName) {
  try {
    settings({"sigma_v=3"}).finish("bearings", {"sigma_u", "damping"});
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "mote run: --set: expected a parameter of bearings (sigma_u, damping), got \"sigma_v\". Did you mean "
                 "sigma_u?");
  }
}

}  // namespace
}  // namespace mote

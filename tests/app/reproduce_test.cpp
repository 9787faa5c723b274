// The papers' items: what `mote reproduce` leaves, and that its comparisons can fail.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/app/reproduce/laboratory.hpp"
#include "mote/base/refusal.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

TEST(Reproduce, WritesComparisonPageAndFigures) {
  const Scratch scratch;
  const Ended ended = scratch.shell("mote reproduce imh-hw --out r");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json comparison = Json::parse(slurp(scratch.path() / "r/comparison.json"));
  ASSERT_FALSE(comparison.empty());
  for (const Json& entry : comparison) {
    for (const std::string key : {"item", "paper", "ours", "ratio", "holds", "note"})
      EXPECT_TRUE(entry.contains(key)) << key;
    EXPECT_EQ(entry.size(), 6U);
    EXPECT_TRUE(entry["holds"].get<bool>()) << entry.dump(2);
  }
  EXPECT_TRUE(slurp(scratch.path() / "r/imh-hw-fig-5.csv").starts_with("t,truth_theta"));
  EXPECT_NE(slurp(scratch.path() / "r/index.html").find("DOA mean"), std::string::npos);
}

TEST(Reproduce, SaysWhenAPaperHasNoItems) {
  const Scratch scratch;
  const Ended ended = scratch.shell("mote reproduce ppf --out r");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("no items yet"), std::string::npos);
  EXPECT_EQ(Json::parse(slurp(scratch.path() / "r/comparison.json")), Json::array());
}

constexpr const char* kItem = R"(item = "Fig. 0"
title = "two filters"
printed = "nothing"
[simulate]
model = "doa"
steps = 30
seed = 5
columns = 6
set = ["sigma_o=0.2"]
[[run]]
name = "right"
options = ["--filter", "sisr", "-n", "500"]
[[run]]
name = "other"
options = ["--filter", "imh", "-n", "500"]
SETTINGS
[[compare]]
name = "difference"
kind = "mean-difference"
runs = ["right", "other"]
state = "theta"
repeats = 20
at_most = 0.7
)";

reproduce::Item item_with(const Scratch& scratch, const std::string& settings) {
  std::string text = kItem;
  text.replace(text.find("SETTINGS"), 8, settings);
  scratch.write("item.toml", text);
  return reproduce::read_item(scratch.file("item.toml"), "imh-hw");
}

// the twin: a filter that believes in four times the measurement error must not hold
TEST(Reproduce, AWrongFilterDoesNotHold) {
  const Scratch scratch;
  EXPECT_TRUE(reproduce::regenerate(item_with(scratch, "")).results.front().holds);
  EXPECT_FALSE(reproduce::regenerate(item_with(scratch, "set = [\"sigma_o=0.8\"]")).results.front().holds);
}

TEST(Reproduce, RefusesBrokenItemsByLine) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& settings) -> std::string {
    try {
      item_with(scratch, settings);
    } catch (const Refusal& refused) {
      return refused.what();
    }
    return "";
  };
  EXPECT_NE(refusal("colour = 3").find("item.toml:16: \"colour\": expected one of name, options, set"),
            std::string::npos)
      << refusal("colour = 3");
  EXPECT_NE(refusal("set = [").find("item.toml:"), std::string::npos);
  EXPECT_NE(refusal("[[compare]]\nname = \"n\"\nkind = \"magic\"\nruns = [\"right\"]").find("mean-difference, rmse"),
            std::string::npos);
  EXPECT_NE(refusal("[[compare]]\nname = \"n\"\nkind = \"rmse\"\nruns = [\"nobody\"]").find("names of the item's runs"),
            std::string::npos);
}

}  // namespace
}  // namespace mote::testing

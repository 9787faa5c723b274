// mote graph: what a model computes, in which ranges, and in how many bits.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

TEST(Graph, ShowsEveryModel) {
  const Scratch scratch;
  scratch.write("growth.toml", slurp(MOTE_SOURCE "/examples/text_models/growth.toml"));
  for (const std::string model : {"ungm --set copies=2", "bearings", "doa --columns 3", "local-level", "growth.toml"}) {
    const Ended ended =
        scratch.shell("mote graph " + model + " --recordings 2 -n 50 --list l.txt --dot d.dot --json j.json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("add\n"), std::string::npos) << ended.out;
    EXPECT_NE(scratch.read("l.txt").find("log_likelihood = v"), std::string::npos);
    EXPECT_TRUE(scratch.read("d.dot").starts_with("digraph"));
    const Json graph = Json::parse(scratch.read("j.json"));
    EXPECT_GT(graph["vertices"].size(), 5U);
    for (const Json& vertex : graph["vertices"]) {
      EXPECT_LE(vertex["range"][0], vertex["seen"][0]) << vertex;
      EXPECT_GE(vertex["range"][1], vertex["seen"][1]) << vertex;
    }
  }
}

// claim    the formats found keep the filter's error within the budget on recordings that the search has not seen
// referee  the double filter, same draws and ancestors
// design   10 recordings of 50 steps, 300 particles; one fixed seed; the budget of 1 % and as much again for the choice
// twin     a budget of 50 %, which must take fewer bits
TEST(Graph, FindsWordsThatKeepTheError) {
  const Scratch scratch;
  const auto words = [&](const std::string& budget) {
    EXPECT_EQ(scratch.shell("mote graph ungm --words -n 300 --json j.json --budget " + budget).code, 0);
    return Json::parse(scratch.read("j.json"))["words"];
  };
  const Json tight = words("0.01");
  EXPECT_TRUE(tight["within_budget"]);
  EXPECT_LE(tight["ratio"], 1.01);
  EXPECT_LE(tight["fresh_ratio"], 1.02);
  EXPECT_LT(words("0.5")["bits"], tight["bits"]);
  EXPECT_FALSE(scratch.shell("mote graph ungm --words -n 10 --budget -1").code == 0);
}

// claim    the files that a model is made of are left as they are
TEST(Graph, WritesNotOverWhatItReads) {
  const Scratch scratch;
  const std::string matrices = "F=[[1]]\nH=[[1]]\nQ=[[1]]\nR=[[1]]\nmean=[0]\ncovariance=[[1]]\n";
  scratch.write("m.toml", matrices);
  const std::string graph = "mote graph linear-gaussian --set file=m.toml --recordings 2 -n 50 ";
  EXPECT_EQ(scratch.shell(graph + "--list l.txt").code, 0);
  EXPECT_EQ(scratch.shell(graph + "--list m.toml").code, 2);
  EXPECT_EQ(scratch.read("m.toml"), matrices);
}

}  // namespace
}  // namespace mote::testing

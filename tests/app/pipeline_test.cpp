// --engine pipeline as a user meets it: the reference's bytes, and what its stages did.

#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

class SamePipelineBytes : public ::testing::TestWithParam<std::string> {};

TEST_P(SamePipelineBytes, WritesTheBytesOfTheReference) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate bearings --steps 15 --out d.csv").code, 0);
  const std::string run = "mote run bearings --data d.csv --estimate 'q0.9(range)' -n 1500 " + GetParam();
  ASSERT_EQ(scratch.shell(run + " --out reference.csv --engine reference").code, 0);
  for (const std::string workers : {"", "--proposers 3 --weighers 2 --threads 4", "--weighers 5 --threads 1"}) {
    const Ended ended = scratch.shell(run + " --out pipeline.csv --engine pipeline " + workers);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("pipeline engine"), std::string::npos);
    EXPECT_EQ(scratch.read("pipeline.csv"), scratch.read("reference.csv")) << workers;
  }
}

INSTANTIATE_TEST_SUITE_P(PipelineEngine, SamePipelineBytes,
                         ::testing::Values("--filter sisr --ess-threshold 0.5", "--filter imh --chains 3 --burn-in 5",
                                           "--filter imh --improved", "--filter imh --burn-in auto",
                                           "--filter auxiliary --proposal guided",
                                           "--filter auxiliary --precision float --parent-weights lookahead"));

TEST(PipelineEngine, SaysWhatItsStagesDid) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate ungm --steps 15 --out d.csv").code, 0);
  const std::string run = "mote run ungm --data d.csv --engine pipeline --proposers 2 --weighers 3 --threads 2 ";
  ASSERT_EQ(scratch.shell(run + "--filter imh --chains 4 --summary s.json --report r.html").code, 0);
  const Json json = Json::parse(scratch.read("s.json"));
  EXPECT_EQ(json["threads"], 2);
  const double all = json["stage_seconds"];
  EXPECT_GT(json["barrier_seconds"], 0);
  const std::map<std::string, std::size_t> workers{{"propose", 2}, {"weigh", 3}, {"chain", 4}};
  ASSERT_EQ(json["stages"].size(), 3U);
  std::size_t blocks = 0;
  for (const Json& stage : json["stages"]) {
    EXPECT_EQ(stage["workers"].size(), workers.at(stage["stage"])) << stage;
    std::size_t here = 0;
    for (const Json& worker : stage["workers"]) {
      EXPECT_NEAR(worker["busy_seconds"].get<double>() + worker["idle_seconds"].get<double>(), all, 1e-9);
      here += worker["blocks"].get<std::size_t>();
    }
    EXPECT_TRUE(blocks == 0 || here == blocks) << "every block passes every stage";
    blocks = here;
  }
  EXPECT_NE(scratch.read("r.html").find("Stages at work, t = 2, 3, 4"), std::string::npos);
  ASSERT_EQ(scratch.shell(run + "--filter sisr --summary s.json").code, 0);
  EXPECT_TRUE(Json::parse(scratch.read("s.json"))["stages"][2]["workers"].empty()) << "SISR has no chains";
  ASSERT_EQ(scratch.shell("mote run ungm --data d.csv --engine reference --summary s.json").code, 0);
  EXPECT_FALSE(Json::parse(scratch.read("s.json")).contains("stages"));
}

}  // namespace
}  // namespace mote::testing

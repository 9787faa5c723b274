// `mote design`: what it answers, and what it refuses.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote {
namespace {

using testing::Ended;
using testing::Scratch;
using Json = nlohmann::json;

const std::string kGrowth = "mote design optimise --tp 19.2 --tw 1 --td 7 -n 840 ";

class Design : public ::testing::Test {
 protected:
  Json optimised(const std::string& words) {
    const Ended ended = scratch_.shell(words + " --json d.json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    return Json::parse(scratch_.read("d.json"));
  }
  Scratch scratch_;
};

// referee  IMH-OPT (44), (46), (48), (49): Q T_d + T_p + T_w
TEST_F(Design, AnswersThePapersProportion) {
  const Json found = optimised(kGrowth);
  for (const char* which : {"A", "B", "C", "D"}) {
    EXPECT_TRUE(found["cases"][which]["feasible"].get<bool>());
    EXPECT_NEAR(found["cases"][which]["time"].get<double>(), 5900.2, 5900.2e-6) << which;
  }
  EXPECT_EQ(found["integer"]["rp"], 3);
  EXPECT_EQ(found["integer"]["rw"], 1);
  EXPECT_EQ(found["integer"]["chains"], 1);
  EXPECT_TRUE(found["integer"]["proven"].get<bool>());
  EXPECT_NEAR(found["integer"]["exact_time"].get<double>(), 5900.2, 1e-6);
  EXPECT_EQ(found["pairs"]["rule"], found["pairs"]["fewest"]);
}

TEST_F(Design, PrintsErrataWhenAsked) {
  EXPECT_LT(optimised(kGrowth + "--as-printed")["cases"]["B"]["time"].get<double>(), 5882);
  const Json equations = optimised(kGrowth + "--as-printed --by-equations");
  EXPECT_FALSE(equations["cases"]["B"]["feasible"].get<bool>());
  EXPECT_TRUE(equations["cases"]["B"]["time"].is_null());
}

TEST_F(Design, SpendsFewBlocksWithinADeadline) {
  const Json loose = optimised(kGrowth + "--deadline 10000 --chains 4");
  const Json tight = optimised(kGrowth + "--deadline 2000 --chains 4");
  EXPECT_LE(loose["integer"]["exact_time"].get<double>(), 10000);
  EXPECT_LE(tight["integer"]["exact_time"].get<double>(), 2000);
  EXPECT_LT(loose["integer"]["blocks"].get<double>(), tight["integer"]["blocks"].get<double>());
  EXPECT_GT(tight["integer"]["chains"].get<int>(), 1) << "one chain takes 5880";
}

TEST_F(Design, NamesTheBudgetThatBinds) {
  const Ended ended = scratch_.shell(kGrowth + "--deadline 5000 --json d.json");
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.out.find("nothing keeps --deadline"), std::string::npos) << ended.out;
  const Json found = Json::parse(scratch_.read("d.json"));
  EXPECT_FALSE(found["integer"]["feasible"].get<bool>());
  EXPECT_EQ(found["integer"]["breaks"], Json::array({"--deadline"}));
  EXPECT_TRUE(found["best"].is_null());
}

TEST_F(Design, MinimisesEnergy) {
  const Json found = optimised(kGrowth + "--minimise energy --idle 1,1,1 --energy 1,1,1");
  EXPECT_EQ(found["integer"]["rp"], 3) << "840 x 3 + 5 blocks x 5900.2 is less than + 4 blocks x 8072 with 2";
  EXPECT_GT(found["integer"]["energy"].get<double>(), 0);
}

TEST_F(Design, RefusesNonsense) {
  for (const auto& [line, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"mote design", "mote design: COMMAND: expected one of measure, optimise, explore"},
           {"mote design optimize", "Did you mean optimise?"},
           {"mote design optimise --tw 1 --td 1", "--tp: expected what a particle takes in that stage, got nothing"},
           {kGrowth + "--deadline -1", "--deadline: expected a number from"},
           {kGrowth + "--weights 1,2", "--weights: expected three numbers"},
           {kGrowth + "--minimise energy", "expected blocks that take energy"},
           {kGrowth + "--by-equations", "--by-equations: expected --as-printed"},
           {"mote design measure nope", "MODEL: expected one of ungm"},
           {"mote design measure ungm --filter ekf", "--filter: expected one of imh"}}) {
    const Ended ended = scratch_.shell(line);
    EXPECT_EQ(ended.code, 2) << line;
    EXPECT_NE(ended.err.find(sentence), std::string::npos) << line << ": " << ended.err;
  }
}

// claim    the laws that speak of a design are held against its schedule; sequential and unbounded ones are exact
TEST_F(Design, SaysHowTheLawsErr) {
  const Json laws = optimised(kGrowth + "--burn-in 20 --chains 4")["laws"];
  for (const char* law : {"L1", "L2"}) EXPECT_NEAR(laws[law]["error"].get<double>(), 0, 1e-12) << law;
  for (const char* law : {"L3", "L4", "L9"}) EXPECT_TRUE(laws.contains(law)) << law;
  const Ended ended = scratch_.shell("mote design laws --demands 300 --json l.json");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(Json::parse(scratch_.read("l.json")).size(), 9U);
  EXPECT_NE(ended.out.find("SISR, with its barrier"), std::string::npos) << ended.out;
}

// claim    predictions stand beside what was measured; how well they hold is a matter of the machine
TEST_F(Design, ChecksItsPredictions) {
  const Ended ended = scratch_.shell("mote design check threads -n 1000 --threads 1 --rounds 1 --json c.json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json checks = Json::parse(scratch_.read("c.json"))["threads"];
  ASSERT_EQ(checks.size(), 3U);
  for (const Json& check : checks)
    EXPECT_NEAR(check["ratio"].get<double>(), check["measured"].get<double>() / check["predicted"].get<double>(), 1e-9);
  EXPECT_NE(ended.out.find("doa, sisr, N = 1000, 1 thread: a step, us"), std::string::npos) << ended.out;
  const Ended refused = scratch_.shell("mote design check luck");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("PART: expected one of threads, circuit, cluster"), std::string::npos) << refused.err;
}

// claim    times of stages are positive, and those of the circuit are its latencies
TEST_F(Design, MeasuresStages) {
  const Ended ended = scratch_.shell("mote design measure ungm -n 1000 --repeats 1 --circuit --json m.json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json found = Json::parse(scratch_.read("m.json"));
  for (const char* stage : {"tp_s", "tw_s", "td_s"})
    EXPECT_GT(found["engines"]["pipeline"][stage]["median"].get<double>(), 0) << stage;
  EXPECT_GT(found["engines"]["simd"]["particle_s"]["median"].get<double>(), 0);
  EXPECT_GT(found["circuit"]["kp"].get<int>(), 4);
  EXPECT_NE(ended.out.find("mote design optimise --tp "), std::string::npos);
}

}  // namespace
}  // namespace mote

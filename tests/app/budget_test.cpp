// mote run --budget: what it chooses, that it can be had again, that it is as good as so many particles. How long steps
// take is asserted nowhere.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

class BudgetRun : public ::testing::TestWithParam<std::string> {
 protected:
  BudgetRun() { scratch_.shell("mote simulate ungm --steps 40 --seed 7 --out o.csv --truth truth.csv"); }
  /// The summary of a run with these words.
  Json run(const std::string& words, const std::string& out = "e.csv") {
    const Ended ended = scratch_.shell("mote run ungm --data o.csv --truth truth.csv --summary s.json --out " + out +
                                       " " + GetParam() + " " + words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    said_ = ended.out;
    noted_ = ended.err;
    return Json::parse(scratch_.read("s.json"));
  }
  Scratch scratch_;
  std::string said_, noted_;
};

// claim    the run that a budget led to is had again, byte for byte, by the words that it prints
TEST_P(BudgetRun, IsHadAgain) {
  const Json first = run("--budget 200us", "a.csv");
  const std::string replay = first["budget"]["replay"];
  EXPECT_NE(said_.find(replay), std::string::npos) << said_;
  const Json again = run(replay, "b.csv");
  EXPECT_EQ(scratch_.read("a.csv"), scratch_.read("b.csv"));
  EXPECT_EQ(first["particles"], first["budget"]["most_particles"]);
  EXPECT_EQ(first["budget"]["particles"], again["budget"]["particles"]);
  EXPECT_TRUE(first["budget"]["fits"].get<bool>());
  EXPECT_LE(first["budget"]["step_seconds"].get<double>(), 200e-6) << "as it was tried";
}

// claim    without a wanted error the run is that of the most particles, byte for byte
// twin     with one, another
TEST_P(BudgetRun, SpendsAllOfItWhenTold) {
  run("--most-particles 3000 --mc-error 0", "a.csv");
  run("-n 3000", "b.csv");
  EXPECT_EQ(scratch_.read("a.csv"), scratch_.read("b.csv"));
  run("--most-particles 3000 --mc-error 0.1", "b.csv");
  EXPECT_NE(scratch_.read("a.csv"), scratch_.read("b.csv"));
}

// claim    what is saved costs no accuracy: a wanted error of 0.05 adds a 400th to the variance
// referee  the run of the most particles, by its error to the truth
// design   40 steps, fixed seeds; the two runs' means differ by their Monte-Carlo errors, which moves the RMSE by up to
// 5 %
TEST_P(BudgetRun, IsAsAccurateAsTheMost) {
  const Json all = run("-n 20000");
  const Json adapted = run("--most-particles 20000 --mc-error 0.05");
  EXPECT_LT(adapted["budget"]["particles"]["mean"].get<double>(), 10000);
  EXPECT_GT(adapted["mean_ess"].get<double>(), 350);
  EXPECT_NEAR(adapted["rmse"]["x"].get<double>(), all["rmse"]["x"].get<double>(),
              0.05 * all["rmse"]["x"].get<double>());
}

INSTANTIATE_TEST_SUITE_P(Of, BudgetRun,
                         ::testing::Values("", "--engine reference", "--filter imh --chains 4",
                                           "--filter auxiliary --engine reference --precision float"));

TEST(Budget, ThatNothingKeepsIsAnsweredByTheFewest) {
  const Scratch scratch;
  scratch.shell("mote simulate ungm --steps 5 --out o.csv");
  const Ended ended = scratch.shell("mote run ungm --data o.csv --summary s.json --budget 1ns --engine reference");
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("note: --budget: 64 particles are the fewest"), std::string::npos) << ended.err;
  const Json json = Json::parse(scratch.read("s.json"));
  EXPECT_EQ(json["particles"], 64);
  EXPECT_FALSE(json["budget"]["fits"].get<bool>());
}

TEST(Budget, SaysNothingOfTimesThatItDidNotTry) {
  const Scratch scratch;
  scratch.shell("mote simulate ungm --steps 5 --out o.csv");
  scratch.shell("mote run ungm --data o.csv --summary s.json --most-particles 500");
  const Json budget = Json::parse(scratch.read("s.json"))["budget"];
  EXPECT_TRUE(budget["fits"].is_null());
  EXPECT_TRUE(budget["step_seconds"].is_null());
}

TEST(Budget, NamesItsOwnOptionsInItsRefusals) {
  const Scratch scratch;
  scratch.write("far.csv", "t,y\n1,0\n2,1e200\n");
  const Ended collapsed = scratch.shell("mote run ungm --data far.csv --most-particles 500");
  EXPECT_EQ(collapsed.code, 4);
  EXPECT_NE(collapsed.err.find("every one of 500 particles"), std::string::npos) << collapsed.err;
  EXPECT_NE(collapsed.err.find("Pass a larger --budget or --most-particles"), std::string::npos) << collapsed.err;
  const Ended large = scratch.shell("ulimit -v 2000000; mote run ungm --data far.csv --most-particles 200000000");
  EXPECT_EQ(large.code, 2);
  EXPECT_NE(large.err.find("Pass fewer --most-particles"), std::string::npos) << large.err;
}

TEST(Budget, CountsBins) {
  const Scratch scratch;
  scratch.shell("mote simulate ungm --steps 20 --out o.csv");
  const auto mean = [&](const std::string& words) {
    scratch.shell("mote run ungm --data o.csv --summary s.json --most-particles 20000 --mc-error 0.2 " + words);
    return Json::parse(scratch.read("s.json"))["budget"]["particles"]["mean"].get<double>();
  };
  EXPECT_GT(mean("--bins 0.05"), 2 * mean(""));
}

}  // namespace
}  // namespace mote::testing

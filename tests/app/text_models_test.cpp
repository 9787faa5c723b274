// Models given as text as a user meets them: every command takes the file, and the numbers are the template's.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mote/app/files/table.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

class TextModels : public ::testing::Test {
 protected:
  TextModels() {
    for (const char* name : {"growth", "bearings", "volatility"})
      scratch_.write(name + std::string(".toml"),
                     slurp(MOTE_SOURCE "/examples/text_models/" + std::string(name) + ".toml"));
  }

  void expect_done(const std::string& line) const {
    const Ended ended = scratch_.shell(line);
    EXPECT_EQ(ended.code, 0) << line << "\n" << ended.err;
  }

  /// The largest difference of two tables, relative to numbers above 1.
  double distance(const std::string& one, const std::string& other) const {
    const Table a = read_table((scratch_.path() / one).string());
    const Table b = read_table((scratch_.path() / other).string());
    EXPECT_EQ(a.lines.size(), b.lines.size());
    double most = 0;
    for (std::size_t i = 0; i < a.lines.size(); ++i)
      for (std::size_t j = 0; j < b.header.size(); ++j) {
        const double u = number_field(a, a.lines[i], j);
        const double v = number_field(b, b.lines[i], j);
        if (std::isnan(u) && std::isnan(v)) continue;
        most = std::max(most, std::abs(u - v) / std::max(1.0, std::abs(v)));
      }
    return most;
  }

  Scratch scratch_;
};

// claim    growth.toml and bearings.toml give the numbers of ungm and bearings up to rounding, by every filter and
// engine referee  the templates, same seed: draws have the same addresses design   20 steps, 1500 particles, a missed
// observation, a gap in t; tolerance 1e-8 twin     the parameter a = 0.501, which must be caught
TEST_F(TextModels, GiveTheNumbersOfTheTemplates) {
  expect_done("mote simulate ungm --steps 20 --seed 4 --out ungm.csv --truth truth.csv");
  expect_done("mote simulate growth.toml --steps 20 --seed 4 --out growth.csv");
  EXPECT_LT(distance("growth.csv", "ungm.csv"), 1e-12);
  expect_done("sed -e '5s/,.*/,/' -e '9d' ungm.csv > d.csv");
  for (const std::string how :
       {"--filter sisr", "--filter sisr --precision double --engine reference", "--filter sisr --ess-threshold 0.5",
        "--filter sisr --resampler residual", "--filter imh --chains 4 --burn-in 3", "--filter imh --improved",
        "--filter auxiliary", "--filter auxiliary --parent-weights lookahead", "--filter distributed --groups 5",
        "--filter sqmc", "--filter ekf", "--filter ukf", "--engine pipeline --weighers 2"}) {
    expect_done("mote run ungm --data d.csv -n 1500 --out a.csv " + how);
    expect_done("mote run growth.toml --data d.csv -n 1500 --out b.csv " + how);
    EXPECT_LT(distance("b.csv", "a.csv"), 1e-8) << how;
  }
  expect_done("mote run ungm --data d.csv -n 1500 --out a.csv");
  expect_done("mote run growth.toml --set a=0.501 --data d.csv -n 1500 --out b.csv");
  EXPECT_GT(distance("b.csv", "a.csv"), 1e-4);
}

// Few particles: one survivor that rounding changes moves all after it, and the chance of that grows like N^2.
TEST_F(TextModels, FollowTheTemplateInFloat) {
  expect_done("mote simulate ungm --steps 20 --seed 4 --out d.csv");
  for (const std::string seed : {"1", "2", "3"}) {
    expect_done("mote run ungm --data d.csv -n 200 --precision float --out a.csv --seed " + seed);
    expect_done("mote run growth.toml --data d.csv -n 200 --precision float --out b.csv --seed " + seed);
    EXPECT_LT(distance("b.csv", "a.csv"), 1e-3) << seed;
  }
}

TEST_F(TextModels, MoveBlocksAsTheReferenceDoes) {
  for (const std::string model : {"growth.toml", "bearings.toml", "volatility.toml"}) {
    expect_done("mote simulate " + model + " --steps 15 --out d.csv");
    for (const std::string how : {"", "--filter imh --chains 2", "--ess-threshold 0.3"}) {
      const std::string run = fmt::format("mote run {} --data d.csv -n 1300 {} ", model, how);
      expect_done(run + "--engine reference --out a.csv");
      expect_done(run + "--engine simd --threads 2 --out b.csv");
      EXPECT_LT(distance("b.csv", "a.csv"), 1e-6) << model << " " << how;
    }
  }
}

TEST_F(TextModels, TakeAnglesAndInputsLikeTheTemplate) {
  scratch_.write(
      "d.csv",
      "t,bearing,sensor_x,sensor_y,sensor_heading\n1,0.7,0,0,0.1\n1,2.9,1,0.1,0\n2,,0,0,0\n4,0.75,0.01,0,0.1\n");
  for (const std::string how : {"--engine simd", "--engine reference", "--filter ukf"}) {
    expect_done("mote run bearings --data d.csv --out a.csv " + how);
    expect_done("mote run bearings.toml --data d.csv --out b.csv " + how);
    EXPECT_LT(distance("b.csv", "a.csv"), 1e-8) << how;
  }
}

TEST_F(TextModels, ReadAnInputWhereTheDataHaveIt) {
  scratch_.write("one.csv", "t,y\n1,2.0\n2,3.0\n");
  scratch_.write("two.csv", "t,y,gain\n1,2.0,1\n2,3.0,4\n");
  expect_done("mote run growth.toml --data one.csv --out a.csv");
  expect_done("mote run growth.toml --data two.csv --out b.csv");
  EXPECT_GT(distance("b.csv", "a.csv"), 1e-3) << "the second row's gain is another";
}

TEST_F(TextModels, AreTakenByOtherCommands) {
  const Ended shown = scratch_.shell("mote models growth.toml");
  EXPECT_EQ(shown.code, 0) << shown.err;
  for (const char* part : {"growth: univariate", "t,y,gain", "q           [10]"})
    EXPECT_NE(shown.out.find(part), std::string::npos) << shown.out;
  expect_done("mote models growth.toml --json");
  expect_done("mote compare growth.toml --filters 'sisr; imh' -n 50 --recordings 2 --repeats 2 --steps 5");
}

TEST_F(TextModels, AreNotWrittenOver) {
  expect_done("mote simulate growth.toml --steps 3 --out d.csv");
  const std::string before = scratch_.read("growth.toml");
  EXPECT_EQ(scratch_.shell("mote simulate growth.toml --steps 3 --out growth.toml").code, 2);
  EXPECT_EQ(scratch_.shell("mote run growth.toml --data d.csv --out growth.toml").code, 2);
  EXPECT_EQ(scratch_.read("growth.toml"), before);
}

TEST_F(TextModels, AreAskedForTheirLawsOnlyToDraw) {
  scratch_.write("m.toml",
                 "[states]\nx = \"normal(0, 1)\"\n[next]\nx = \"x + normal(0, 1)\"\n[observations]\nlog_likelihood = "
                 "\"-abs(y - x)\"\n");
  scratch_.write("d.csv", "t,y\n1,2.0\n2,3.0\n");
  expect_done("mote run m.toml --data d.csv --filter imh");
  for (const std::string line : {"mote simulate m.toml --out o.csv", "mote run m.toml --data d.csv --filter ekf"}) {
    const Ended ended = scratch_.shell(line);
    EXPECT_EQ(ended.code, 2) << line;
    EXPECT_NE(ended.err.find("observation \"y\": expected a law that it can be drawn from, got none."),
              std::string::npos)
        << ended.err;
  }
}

}  // namespace
}  // namespace mote::testing

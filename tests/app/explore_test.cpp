// `mote design explore`: what it answers, what it refuses, and that it goes on where it was.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/base/numbers.hpp"
#include "tests/app/program.hpp"

namespace mote {
namespace {

using testing::Ended;
using testing::Scratch;
using Json = nlohmann::json;

const std::string kSmall =
    "mote design explore ungm --target cpu --kinds sisr,imh -n 64,256 --steps 20 --recordings 4 --first-runs 4 "
    "--runs 8 ";

class Explore : public ::testing::Test {
 protected:
  Json explored(const std::string& words) {
    const Ended ended = scratch_.shell(words + " --json e.json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    out_ = ended.out;
    return Json::parse(scratch_.read("e.json"));
  }
  Scratch scratch_;
  std::string out_;
};

TEST_F(Explore, PrintsTheCommandThatRunsThePick) {
  const Json found = explored(kSmall + "--deadline 10ms --report e.html");
  const Json& pick = found["pick"];
  EXPECT_TRUE(pick["feasible"].get<bool>());
  EXPECT_TRUE(pick["breaks"].empty());
  EXPECT_EQ(found["goal"], "rmse");
  EXPECT_EQ(pick["runs"], 8);
  EXPECT_GT(pick["time_s"].get<double>(), 0);
  EXPECT_LT(pick["rmse_interval"][0].get<double>(), pick["rmse"].get<double>());
  EXPECT_EQ(found["candidates"], found["all"].size());
  const auto command = pick["command"].get<std::string>();
  EXPECT_TRUE(out_.ends_with(command + "\n")) << out_;
  const Ended ran = scratch_.shell("mote simulate ungm --steps 20 --seed 3 --out obs.csv && " + command);
  EXPECT_EQ(ran.code, 0) << command << ": " << ran.err;
  EXPECT_FALSE(scratch_.read("estimates.csv").empty());
  EXPECT_NE(scratch_.read("e.html").find(command), std::string::npos) << "where a point is pointed at";
}

// referee  every pair of candidates
TEST_F(Explore, ListsWhatNothingBeats) {
  const Json found = explored(kSmall);
  ASSERT_FALSE(found["frontier"].empty());
  const auto beats = [](const Json& a, const Json& b) {
    bool less = false;
    for (const char* axis : {"rmse", "time_s", "threads"}) {
      if (a[axis].get<double>() > b[axis].get<double>()) return false;
      less = less || a[axis].get<double>() < b[axis].get<double>();
    }
    return less;
  };
  std::size_t unbeaten = 0;
  for (const Json& b : found["all"]) {
    bool beaten = false;
    for (const Json& a : found["all"]) beaten = beaten || beats(a, b);
    unbeaten += beaten ? 0 : 1;
  }
  EXPECT_EQ(unbeaten, found["frontier"].size());
}

// claim    wherever it was cut off among its runs, the same command ends with the same bytes; a whole state makes no
// run
TEST_F(Explore, GoesOnWhereItWasCutOff) {
  explored(kSmall);
  const std::string whole = scratch_.read("e.json");
  const std::string state = scratch_.read("e.json.state");
  const std::size_t first_run = state.find("{\"candidate\"");
  ASSERT_NE(first_run, std::string::npos);
  for (const double share : {0.0, 0.4, 0.9}) {
    const auto kept = first_run + static_cast<std::size_t>(share * static_cast<double>(state.size() - first_run));
    scratch_.write("e.json.state", state.substr(0, kept));
    explored(kSmall);
    EXPECT_EQ(scratch_.read("e.json"), whole) << share;
    EXPECT_EQ(scratch_.read("e.json.state").size(), state.size()) << share;
  }
}

TEST_F(Explore, AnswersWhatCannotBeByTheNearest) {
  const Json found = explored(kSmall + "--deadline 1ns --max-rmse 1000");
  EXPECT_FALSE(found["pick"]["feasible"].get<bool>());
  ASSERT_EQ(found["pick"]["breaks"].size(), 1U);
  EXPECT_EQ(found["pick"]["breaks"][0]["budget"], "--deadline");
  EXPECT_GT(found["pick"]["breaks"][0]["factor"].get<double>(), 1);
  EXPECT_NE(out_.find("Not feasible: nothing keeps all budgets. Nearest, over --deadline by a factor of "),
            std::string::npos)
      << out_;
}

TEST_F(Explore, SpendsTheLeastForAnError) {
  const Json loose = explored(kSmall + "--max-rmse 1000");
  EXPECT_EQ(loose["goal"], "time_s") << "what has no budget";
  for (const Json& candidate : loose["all"])
    EXPECT_GE(candidate["time_s"].get<double>(), loose["pick"]["time_s"].get<double>());
}

TEST_F(Explore, JudgesByARecordingThatIsGiven) {
  scratch_.shell("mote simulate ungm --steps 20 --seed 3 --out obs.csv --truth truth.csv");
  const Json found = explored(
      "mote design explore ungm --target cpu --kinds sisr -n 64,256 --runs 4 --first-runs 4 --data obs.csv --truth "
      "truth.csv");
  EXPECT_EQ(found["source"], "obs.csv");
  EXPECT_GT(found["pick"]["rmse_truth"].get<double>(), found["pick"]["rmse"].get<double>());
  EXPECT_NE(found["pick"]["command"].get<std::string>().find("--data obs.csv"), std::string::npos);
  scratch_.shell("mote simulate ungm --steps 20 --seed 4 --out obs.csv --truth truth.csv");
  const Ended other = scratch_.shell(
      "mote design explore ungm --target cpu --kinds sisr -n 64,256 --runs 4 --first-runs 4 --data obs.csv --truth "
      "truth.csv --json e.json");
  EXPECT_EQ(other.code, 2) << "the state is that of other data";
}

/// A stand-in for Yosys: every part has 100 look-up tables, 60 flip-flops, a DSP block, two memory blocks and a path
/// through one look-up table.
const std::string kYosys =
    "#!/bin/sh\n"
    "net=$(printf %s \"$*\" | sed 's/.*write_json \\([^;]*\\);.*/\\1/')\n"
    "stat=$(printf %s \"$*\" | sed 's/.*tee -o \\([^ ]*\\) stat.*/\\1/')\n"
    "printf 'Number of cells: 163\\n LUT2 100\\n FDRE 60\\n DSP48E1 1\\n RAMB36E1 1\\n' >\"$stat\"\n"
    "cat >\"$net\" <<END\n"
    R"({"modules":{"core":{"cells":{)"
    R"("a":{"type":"FDRE","parameters":{},"port_directions":{"C":"input","D":"input","Q":"output"},)"
    R"("connections":{"C":[2],"D":[4],"Q":[3]}},)"
    R"("b":{"type":"LUT1","parameters":{},"port_directions":{"I0":"input","O":"output"},)"
    R"("connections":{"I0":[3],"O":[4]}}}}}})"
    "\nEND\n";

// claim    circuits are judged with what they take of a device by their parts; the pick's command writes one
// referee  a stand-in for Yosys, whose areas are known: three parts, of which one has a table and grows with N
TEST_F(Explore, FindsCircuits) {
  scratch_.shell("mkdir bin");
  scratch_.write("bin/yosys", kYosys);
  scratch_.shell("chmod +x bin/yosys");
  const Json found = explored(
      "PATH=\"$PWD/bin:$PATH\" mote design explore local-level --target fpga:xc7a35t --kinds imh,sisr -n 64,1024 "
      "--more-bits 0 --steps 10 --recordings 2 --first-runs 2 --runs 4 --max-lut 15000 --max-power 500mW --deadline "
      "1ms");
  const Json& pick = found["pick"];
  EXPECT_TRUE(pick["feasible"].get<bool>()) << out_;
  EXPECT_EQ(pick["lanes"], 1);
  EXPECT_EQ(pick["lut"], 300);
  EXPECT_EQ(pick["ff"], 180);
  EXPECT_EQ(pick["dsp"], 3);
  EXPECT_EQ(pick["bram18"], 6);
  EXPECT_DOUBLE_EQ(pick["area"].get<double>(), 6.0 / 100) << "the largest share of the device is memory's";
  std::string command = pick["command"].get<std::string>();
  const std::size_t synthesis = command.find(" --synth xc7");
  ASSERT_NE(synthesis, std::string::npos) << command;
  EXPECT_EQ(scratch_.shell(command.erase(synthesis, 12)).code, 0) << command;
}

TEST_F(Explore, FindsRanksOfACluster) {
  const Ended ended = scratch_.shell(
      "mote design explore local-level --target cluster --kinds sisr,stages -n 4096 --workers 1,2 --steps 5 "
      "--recordings 1 --first-runs 1 --runs 1 --json e.json");
  if (ended.code == 5) GTEST_SKIP() << "no SimGrid: " << ended.err;
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json found = Json::parse(scratch_.read("e.json"));
  EXPECT_GT(found["pick"]["ranks"].get<int>(), 0);
  EXPECT_TRUE(found["pick"]["command"].get<std::string>().starts_with("mpirun -n ")) << ended.out;
}

// claim    mixed-mode filters are judged with what their circuits take; the pick's command runs on a recording
// referee  twice the particles take twice the time, two bits more take four times the converters, eight copies an
//          eighth of the time
TEST_F(Explore, FindsMixedModeFilters) {
  const std::string words =
      "mote design explore bearings --target mixed -n 64,128 --currents 10 --bits 6,8 --workers 1,8 --steps 10 "
      "--recordings 2 --first-runs 2 --runs 4 --deadline 20ms --max-power 2mW ";
  const Ended ended = scratch_.shell(words + "--json e.json");
  if (ended.code == 5) GTEST_SKIP() << ended.err;
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json found = Json::parse(scratch_.read("e.json"));
  EXPECT_TRUE(found["pick"]["feasible"].get<bool>());
  const auto command = found["pick"]["command"].get<std::string>();
  EXPECT_TRUE(command.starts_with("mote analog run bearings ")) << command;
  const auto figure = [&](const std::string& candidate, const char* name) {
    for (const Json& one : found["all"])
      if (one["words"] == candidate) return one[name].get<double>();
    ADD_FAILURE() << "no candidate " << candidate;
    return kNaN;
  };
  const std::string circuits = " --analog arctan=mite:Ia=10n,gaussian=mite:Ia=10n";
  const auto one = [&](int n, const std::string& more) {
    return "--method 1 --filter sisr -n " + std::to_string(n) + circuits + more;
  };
  const std::string coarse = " --dac-bits 8 --adc-bits 6 copies=1";
  const std::string fine = " --dac-bits 10 --adc-bits 8 copies=1";
  EXPECT_NEAR(figure(one(128, coarse), "time_s"), 2 * figure(one(64, coarse), "time_s"), 1e-12);
  EXPECT_NEAR(figure(one(64, fine), "power_mw") - figure(one(64, coarse), "power_mw"), 0.75 * 0.93, 1e-9);
  EXPECT_NEAR(figure(one(64, " --dac-bits 8 --adc-bits 6 copies=8"), "time_s"), figure(one(64, coarse), "time_s") / 8,
              1e-12);
  EXPECT_LT(figure("--method 3 --filter imh -n 64 --analog arctan=mite:Ia=10n copies=1", "power_mw"),
            figure(one(64, coarse), "power_mw"));
  const Ended ran = scratch_.shell("mote simulate bearings --steps 10 --seed 3 --out obs.csv && " + command);
  EXPECT_EQ(ran.code, 0) << command << ": " << ran.err;
  EXPECT_EQ(scratch_.shell(words + "--max-lut 100").code, 2);
}

TEST_F(Explore, RefusesNonsense) {
  const std::string explore = "mote design explore ungm ";
  for (const auto& [line, sentence] : std::vector<std::pair<std::string, std::string>>{
           {explore, "--target: expected cpu, cluster, mixed or fpga:DEVICE, got nothing"},
           {explore + "--target gpu", "--target: expected cpu, cluster, mixed or fpga:DEVICE, got \"gpu\""},
           {explore + "--target cpu --currents 10", "--currents: expected --target mixed, got --target cpu"},
           {explore + "--target fpga:xc9", "--target: expected fpga: with one of xc7a15t"},
           {explore + "--target cpu --deadline 1",
            "--deadline: expected a number above 0 with its unit (ms, us, ns, s)"},
           {explore + "--target cpu --max-lut 100", "--max-lut: expected a target that has it, got --target cpu"},
           {explore + "--target cpu --kinds sisr,what", "--kinds: expected some of sisr, imh"},
           {explore + "--target cpu --minimise power", "--minimise: expected one of rmse, time, threads"},
           {explore + "--target cpu -n 0", "--particles: expected integers from 1 to"},
           {explore + "--target cpu --max-rmse -1", "--max-rmse: expected a number from"},
           {explore + "--target cpu --truth t.csv", "--truth: expected --data"},
           {"mote design explore nope --target cpu", "MODEL: expected one of ungm"}}) {
    const Ended ended = scratch_.shell(line);
    EXPECT_EQ(ended.code, 2) << line;
    EXPECT_NE(ended.err.find(sentence), std::string::npos) << line << ": " << ended.err;
  }
}

}  // namespace
}  // namespace mote

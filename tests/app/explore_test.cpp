// `mote design explore`: what it answers, what it refuses, and that it goes on where it was.

#include <algorithm>
#include <regex>
#include <set>

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

// claim    the frontier has whom nobody beats, judged by as many runs as each other
// referee  every pair of candidates that all runs judged
TEST_F(Explore, ListsWhatNothingBeats) {
  const Json found = explored(kSmall);
  const auto beats = [](const Json& a, const Json& b) {
    bool less = false;
    for (const char* axis : {"rmse", "time_s", "threads"}) {
      if (a[axis].get<double>() > b[axis].get<double>()) return false;
      less = less || a[axis].get<double>() < b[axis].get<double>();
    }
    return less;
  };
  const auto& all = found["all"];
  std::set<std::string> unbeaten;
  for (const Json& b : all)
    if (b["runs"] == 8 &&
        std::none_of(all.begin(), all.end(), [&](const Json& a) { return a["runs"] == 8 && beats(a, b); }))
      unbeaten.insert(b["words"].get<std::string>());
  std::set<std::string> listed;
  for (const Json& one : found["frontier"]) listed.insert(one["words"].get<std::string>());
  EXPECT_EQ(listed, unbeaten);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Json& one) { return one["runs"] == 4; }))
      << "not all are judged by all runs";
}

// claim    a filter that collapses while it is timed is marked, the others are judged
// referee  a square beyond the range of float, which a filter in double takes
TEST_F(Explore, GoesOnWithoutWhoCollapses) {
  scratch_.write("far.csv", "t,y\n1,1100\n2,1e25\n3,1200\n");
  const Json found = explored(
      "mote design explore local-level --target cpu --kinds sisr -n 64 --set p0=1e50 --set var_obs=1e50 --set "
      "var_level=1e50 --data far.csv --runs 4 --first-runs 4");
  for (const Json& one : found["all"]) {
    const bool in_float = one["words"].get<std::string>().find("float") != std::string::npos;
    EXPECT_EQ(one["collapsed"].get<bool>(), in_float) << one.dump();
    EXPECT_EQ(one["time_s"].is_null(), in_float);
  }
  EXPECT_NE(out_.find(" collapsed; RMSE"), std::string::npos) << out_;
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

// claim    a state is gone on from by the same exploration only, whatever differs; a refused one stays as it is
// twin     the same command goes on
TEST_F(Explore, RefusesTheStateOfAnother) {
  const std::string matrices = R"({"F":[[1]],"Q":[[1]],"H":[[1]],"R":[[1]],"mean":[0],"covariance":[[1]]})";
  scratch_.write("m.json", matrices);
  const std::string few = " --target cpu --kinds sisr -n 64 --steps 5 --recordings 1 --first-runs 1 --runs 1 --json ";
  const std::string frames = "mote design explore doa" + few + "f.json --columns ";
  const std::string linear = "mote design explore linear-gaussian --set file=m.json" + few + "l.json";
  ASSERT_EQ(scratch_.shell(frames + "2").code, 0);
  ASSERT_EQ(scratch_.shell(linear).code, 0) << scratch_.shell(linear).err;
  EXPECT_EQ(scratch_.shell(frames + "2").code, 0);
  EXPECT_EQ(scratch_.shell(linear).code, 0);
  const std::string state = scratch_.read("f.json.state");
  EXPECT_EQ(scratch_.shell(frames + "3").code, 2);
  EXPECT_EQ(scratch_.read("f.json.state"), state);
  scratch_.write("m.json", std::regex_replace(matrices, std::regex("Q.:..1"), "Q\":[[2"));
  const Ended other = scratch_.shell(linear);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("with matrices of checksum"), std::string::npos) << other.err;
  const std::string version = std::regex_replace(state, std::regex("\"mote\",\"[^\"]*\""), "\"mote\",\"0\"");
  ASSERT_NE(version, state);
  scratch_.write("f.json.state", version);
  EXPECT_EQ(scratch_.shell(frames + "2").code, 2) << "another version";
}

TEST_F(Explore, NamesADamagedLineOfTheState) {
  explored(kSmall);
  const std::string state = scratch_.read("e.json.state");
  scratch_.write("e.json.state", state + "{\"foo\":1}\n");
  const Ended ended = scratch_.shell(kSmall + "--json e.json");
  EXPECT_EQ(ended.code, 3);
  const auto line = 1 + std::count(state.begin(), state.end(), '\n');
  EXPECT_NE(ended.err.find("e.json.state:" + std::to_string(line) + ": expected a finding"), std::string::npos)
      << ended.err;
  EXPECT_EQ(scratch_.read("e.json.state"), state + "{\"foo\":1}\n") << "nothing is lost";
}

/// A stand-in for Yosys: every pipeline has 100 look-up tables, 60 flip-flops, a DSP block and two memory blocks, a
/// whole circuit three times as much, and a path leads through one look-up table.
const std::string kYosys =
    "#!/bin/sh\n"
    "top=$(printf %s \"$*\" | sed 's/.*-top \\([^;]*\\);.*/\\1/')\n"
    "net=$(printf %s \"$*\" | sed 's/.*write_json \\([^;]*\\);.*/\\1/')\n"
    "stat=$(printf %s \"$*\" | sed 's/.*tee -o \\([^ ]*\\) stat.*/\\1/')\n"
    "k=3; [ \"$top\" = core ] && k=1\n"
    "printf 'Number of cells: 163\\n LUT2 %d\\n FDRE %d\\n DSP48E1 %d\\n RAMB36E1 %d\\n' "
    "$((100 * k)) $((60 * k)) $k $k >\"$stat\"\n"
    "cat >\"$net\" <<END\n"
    R"({"modules":{"$top":{"cells":{)"
    R"("a":{"type":"FDRE","parameters":{},"port_directions":{"C":"input","D":"input","Q":"output"},)"
    R"("connections":{"C":[2],"D":[4],"Q":[3]}},)"
    R"("b":{"type":"LUT1","parameters":{},"port_directions":{"I0":"input","O":"output"},)"
    R"("connections":{"I0":[3],"O":[4]}}}}}})"
    "\nEND\n";

// claim    circuits are judged with what they take of a device by their parts; the pick's command writes one
// referee  a stand-in for Yosys, whose areas are known: of a circuit's six memory blocks four are its
//          pipelines' and one is a table; the last holds two sets of up to 512 particles at N = 1024, or four of these
//          at N = 2048
TEST_F(Explore, FindsCircuits) {
  scratch_.shell("mkdir bin");
  scratch_.write("bin/yosys", kYosys);
  scratch_.shell("chmod +x bin/yosys");
  const Json found = explored(
      "PATH=\"$PWD/bin:$PATH\" mote design explore local-level --target fpga:xc7a35t --kinds imh,sisr -n 64,1024,2048 "
      "--more-bits -2,0 --steps 10 --recordings 2 --first-runs 2 --runs 4 --max-lut 15000 --max-power 500mW --deadline "
      "1ms");
  const Json& pick = found["pick"];
  EXPECT_TRUE(pick["feasible"].get<bool>()) << out_;
  EXPECT_EQ(pick["lanes"], 1);
  EXPECT_EQ(pick["lut"], 300);
  EXPECT_EQ(pick["ff"], 180);
  EXPECT_EQ(pick["dsp"], 3);
  EXPECT_DOUBLE_EQ(pick["area"].get<double>(), pick["bram18"].get<double>() / 100)
      << "the largest share of the device is memory's";
  std::set<std::string> folders;
  for (const Json& one : found["all"]) {
    const auto words = one["words"].get<std::string>();
    EXPECT_EQ(one["bram18"], words.find("-n 2048") == std::string::npos ? 6 : 7) << words;
    const auto line = one["command"].get<std::string>();
    folders.insert(line.substr(line.rfind(' ')));
  }
  EXPECT_EQ(folders.size(), found["all"].size()) << "each is written to a folder of its own";
  std::string command = pick["command"].get<std::string>();
  const std::size_t synthesis = command.find(" --synth xc7");
  ASSERT_NE(synthesis, std::string::npos) << command;
  EXPECT_EQ(scratch_.shell(command.erase(synthesis, 12)).code, 0) << command;
}

TEST_F(Explore, FindsRanksOfACluster) {
  const Ended ended = scratch_.shell(
      "mote design explore local-level --target cluster --kinds sisr,stages -n 4096 --workers 1,2 --steps 5 "
      "--recordings 1 --first-runs 1 --runs 1 --json e.json");
  if (!testing::kSimulates) GTEST_SKIP() << "built without SimGrid";
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json found = Json::parse(scratch_.read("e.json"));
  for (const char* none : {"--kinds sisr -n 16 --workers 8", "--kinds stages --workers 1024"}) {
    const Ended refused = scratch_.shell(std::string("mote design explore ungm --target cluster ") + none);
    EXPECT_EQ(refused.code, 2) << none;
    EXPECT_NE(refused.err.find("got no candidate"), std::string::npos) << refused.err;
  }
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
  scratch_.write("level.toml",
                 "name = \"level\"\n[states]\nx = \"normal(0, 1)\"\n[next]\nx = \"x + normal(0, 1)\"\n"
                 "[observations]\ny = \"normal(x, 1)\"\n");
  for (const auto& [line, sentence] : std::vector<std::pair<std::string, std::string>>{
           {explore, "--target: expected cpu, cluster, mixed or fpga:DEVICE, got nothing"},
           {explore + "--target gpu", "--target: expected cpu, cluster, mixed or fpga:DEVICE, got \"gpu\""},
           {explore + "--target fpga", "Pass --target fpga:xc7a100t."},
           {explore + "--target cpu --platform red", "--platform: expected --target cluster, got --target cpu"},
           {explore + "--target cpu --more-bits 0", "--more-bits: expected --target fpga:xc7a100t, got --target cpu"},
           {explore + "--target cpu --columns 3", "--columns: expected a model of frames, as doa, got \"ungm\""},
           {explore + "--target cpu --first-runs 9 --runs 8", "--first-runs: expected at most --runs 8, got 9"},
           {explore + "--target cpu -n ,", "--particles: expected integers from 1 to"},
           {explore + "--target fpga:xc7a35t --kinds imh,sisr --workers 4",
            "--workers: expected a kind of circuit with lanes, got --kinds imh,sisr"},
           {"mote design explore level.toml --target fpga:xc7a35t --kinds auxiliary", "got no candidate"},
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

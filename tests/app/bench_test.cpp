// mote bench as a user meets it: verdicts, table, files, refusals, Ctrl-C.

#include <algorithm>
#include <chrono>
#include <regex>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

std::set<std::string> names_in(const Json& list) {
  std::set<std::string> names;
  for (const Json& entry : list) names.insert(entry["contender"]);
  return names;
}

TEST(Bench, ChecksAndTimesEveryTask) {
  const Scratch scratch;
  const Ended ended = scratch.shell("mote bench -n 30,8 --repeats 2 --threads 2 --json r.json --report r.html");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(ended.err.empty()) << ended.err;
  const Json json = Json::parse(scratch.read("r.json"));
  ASSERT_EQ(json["tasks"].size(), 10U);
  for (const Json& task : json["tasks"]) {
    const std::string name = task["task"];
    EXPECT_NE(ended.out.find("\n" + name + ": "), std::string::npos);
    const bool by_blocks = name == "ranks";  // a block of particles for each rank at least, so one number of particles
    EXPECT_EQ(task["results"].size(), (by_blocks ? 1 : 2) * task["checks"].size())
        << name << ": who was checked was timed, once for each number of particles";
    for (const Json& check : task["checks"]) {
      EXPECT_GE(check["value"], check["low"]) << name << ' ' << check;
      EXPECT_LE(check["value"], check["high"]) << name << ' ' << check;
    }
    for (const Json& result : task["results"]) {
      EXPECT_EQ(result["rounds"].size(), 2U) << name;
      EXPECT_GT(result["ns_per_particle_step"], 0) << name << ' ' << result["contender"];
      if (name.starts_with("pipeline"))
        EXPECT_GT(task["results"][0]["ratio_to_predicted"], 0) << name;
      else
        EXPECT_GT(result["bytes_per_particle_step"], 0) << name << ' ' << result["contender"];
    }
    EXPECT_EQ(task["results"][0]["particles"], by_blocks ? 2048 : 8) << "growing";
    EXPECT_EQ(task["results"][0]["ratio_to_first"], 1.0);
  }
  EXPECT_NE(scratch.read("r.html").find("ungm-float: growth model"), std::string::npos);
}

TEST(Bench, NamesWhoIsLeftOutAndWhy) {
  const Scratch scratch;
  const Ended ended = scratch.shell("PATH=/nowhere mote bench ungm-double -n 8 --repeats 1 --json r.json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(
      ended.out.find("numpy is left out: python3 with numpy is missing (Debian: apt-get install python3-numpy).\n"),
      std::string::npos)
      << ended.out;
  const Json task = Json::parse(scratch.read("r.json"))["tasks"][0];
  auto all = names_in(task["checks"]);
  const auto absent = names_in(task["left_out"]);
  EXPECT_TRUE(absent.contains("numpy"));
  all.insert(absent.begin(), absent.end());
  EXPECT_EQ(all, (std::set<std::string>{"baseline", "limit", "numpy", "reference", "simd", "simd+sd"}));
}

TEST(Bench, RunsTasksOnceInTheOrderOfTheList) {
  const Scratch scratch;
  const Ended ended = scratch.shell("mote bench resample doa resample -n 10 --repeats 1 --json -");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json tasks = Json::parse(ended.out)["tasks"];
  ASSERT_EQ(tasks.size(), 2U);
  EXPECT_EQ(tasks[0]["task"], "doa");
  EXPECT_EQ(tasks[1]["task"], "resample");
}

struct BenchRefusal {
  std::string name, words, sentence;
};

std::ostream& operator<<(std::ostream& out, const BenchRefusal& r) { return out << r.name; }

class BenchRefuses : public ::testing::TestWithParam<BenchRefusal> {};

TEST_P(BenchRefuses, InOneSentence) {
  const Scratch scratch;
  const Ended ended = scratch.shell("mote bench " + GetParam().words + " --json r.json");
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_TRUE(std::regex_search(ended.err, std::regex(GetParam().sentence))) << ended.err;
  EXPECT_TRUE(std::regex_match(ended.err, std::regex(R"(^[^\n]+: expected [^\n]+, got [^\n]+\. [A-Z][^\n]+[.?]\n$)")))
      << ended.err;
  EXPECT_TRUE(scratch.files().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Doors, BenchRefuses,
    ::testing::Values(
        BenchRefusal{
            "UnknownTask", "ungm-flaot",
            R"(^mote bench: TASK: expected some of ungm-float, .*, pipeline-2, got "ungm-flaot"\. Did you mean)"},
        BenchRefusal{"NoParticles", "doa -n 0", "--particles: expected integers from 1 to"},
        BenchRefusal{"NoRepeats", "doa --repeats 0", "--repeats: expected an integer from 1 to 10000, got 0"},
        BenchRefusal{"NoThreads", "threads --threads 0", "--threads: expected an integer from 1 to 1024, got 0"},
        BenchRefusal{"SameFileTwice", "doa --report r.json", "r.json"}),
    [](const auto& test) { return test.param.name; });

TEST(Bench, EndsCleanlyByCtrlC) {
  const Scratch scratch;
  Child child(scratch, {"bench", "resample", "-n", "1000000", "--repeats", "1000", "--json", "r.json"});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  child.signal(SIGINT);
  const auto end = child.end();
  EXPECT_EQ(end.code, 130) << end.err;
  EXPECT_EQ(end.err, "mote bench: resample: interrupted; no file was written.\n");
  EXPECT_TRUE(scratch.files().empty());
}

}  // namespace
}  // namespace mote::testing

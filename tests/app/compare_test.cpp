// mote compare as a user meets it: table, files, refusals, Ctrl-C.

#include <algorithm>
#include <chrono>
#include <regex>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

const std::string kSmall = "mote compare local-level --steps 20 --recordings 2 --repeats 3 -n 100,20 ";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Compare, PrintsAnAlignedTable) {
  const Scratch scratch;
  const Ended ended = scratch.shell(kSmall + "--filters 'sisr; imh --chains 4'");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(ended.err.empty()) << ended.err;
  const auto lines = lines_of(ended.out);
  ASSERT_GE(lines.size(), 6U);
  EXPECT_EQ(lines[0],
            "local-level: 2 recordings of 20 steps (seeds 1 to 2), 3 repeats (filter seeds 1 to 6); reference: Kalman "
            "filter (exact)");
  EXPECT_TRUE(std::regex_match(
      lines[1], std::regex("filter +N +RMSE +MSE +ratio +NEES +cover +collapsed +log evidence +its sd +ns +s")))
      << lines[1];
  for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(lines[i].size(), lines[1].size());
  EXPECT_TRUE(lines[2].starts_with("sisr             20 ")) << "by particles, growing";
  EXPECT_TRUE(lines[5].starts_with("imh --chains 4  100 "));
}

TEST(Compare, ShowsWhatGroupsSend) {
  const Scratch scratch;
  const Ended ended = scratch.shell(
      "mote compare local-level --steps 9 --recordings 1 --repeats 2 -n 64 --json r.json "
      "--filters 'sisr; distributed --groups 4 --exchange swap --exchange-every 3'");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(std::regex_search(lines_of(ended.out)[1], std::regex("its sd +messages +bytes +ns +s$"))) << ended.out;
  const Json json = Json::parse(scratch.read("r.json"));
  EXPECT_EQ(json["results"][0]["bytes_per_step"], 0);
  EXPECT_DOUBLE_EQ(json["results"][1]["messages_per_step"], 4.0 / 3);
  EXPECT_DOUBLE_EQ(json["results"][1]["bytes_per_step"], 4 * 16.0 / 3);
}

TEST(Compare, WritesTheSameNumbersEverywhereAndEveryTime) {
  const Scratch scratch;
  const std::string line = kSmall + "--filters 'sisr; sisr; imh' --out t.csv --json r.json --report r.html";
  ASSERT_EQ(scratch.shell(line).code, 0);
  const Json json = Json::parse(scratch.read("r.json"));
  const auto rows = lines_of(scratch.read("t.csv"));
  ASSERT_EQ(json["results"].size(), 6U);
  ASSERT_EQ(rows.size(), 7U);
  const auto columns = [](const std::string& row) { return std::count(row.begin(), row.end(), ','); };
  for (const std::string& row : rows) EXPECT_EQ(columns(row), columns(rows[0]));
  EXPECT_TRUE(rows[3].starts_with("local-level,\"sisr (2)\",20,")) << rows[3];
  EXPECT_EQ(json["results"][2]["ratio"], 1.0);
  EXPECT_EQ(json["results"][2]["ratio_interval"], Json({1.0, 1.0}));
  EXPECT_EQ(json["reference"]["log_evidence"].size(), 2U);
  std::vector<int> seeds;
  for (const Json& run : json["results"][5]["runs"]) seeds.push_back(run["seed"]);
  EXPECT_EQ(seeds, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_NE(scratch.read("r.html").find("local-level: error against wall-clock"), std::string::npos);
  ASSERT_EQ(scratch.shell(line).code, 0);
  Json again = Json::parse(scratch.read("r.json"));
  for (std::size_t i = 0; i < 6; ++i)
    for (const std::string number : {"mse_median", "mse_mean_interval", "ratio", "nees", "log_evidence_sd"})
      EXPECT_EQ(again["results"][i][number], json["results"][i][number]);
}

TEST(Compare, TakesSeveralModels) {
  const Scratch scratch;
  const std::string words =
      " --steps 10 --recordings 1 --repeats 2 -n 50 --filters 'sisr; imh' --reference 'sisr -n 500'";
  const Ended both = scratch.shell("mote compare ungm,bearings" + words + " --out t.csv --json r.json --report r.html");
  ASSERT_EQ(both.code, 0) << both.err;
  const auto rows = lines_of(scratch.read("t.csv"));
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_TRUE(rows[1].starts_with("ungm,\"sisr\",50,")) << rows[1];
  EXPECT_TRUE(rows[4].starts_with("bearings,\"imh\",50,")) << rows[4];
  const Json json = Json::parse(scratch.read("r.json"));
  ASSERT_EQ(json.size(), 2U);
  for (const std::string title : {"ungm: error against wall-clock", "bearings: error against wall-clock"})
    EXPECT_NE(scratch.read("r.html").find(title), std::string::npos);
  ASSERT_EQ(scratch.shell("mote compare bearings" + words + " --json alone.json").code, 0);
  const Json alone = Json::parse(scratch.read("alone.json"));
  EXPECT_EQ(json[1]["results"][1]["mse_median"], alone["results"][1]["mse_median"]);
  const Ended unknown = scratch.shell("mote compare ungm,bearing" + words);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("Did you mean bearings"), std::string::npos) << unknown.err;
}

// A run of the comparison is the run that mote run makes of the same recording with the same seed.
TEST(Compare, RunsWhatMoteRunRuns) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell(kSmall + "--filters 'imh --improved' --json r.json").code, 0);
  ASSERT_EQ(
      scratch
          .shell("mote simulate local-level --steps 20 --seed 2 --out d.csv --truth t.csv && mote run local-level "
                 "--data d.csv --truth t.csv --filter imh --improved -n 100 --seed 5 --summary s.json")
          .code,
      0);
  const Json run = Json::parse(scratch.read("r.json"))["results"][1]["runs"][4];
  const Json summary = Json::parse(scratch.read("s.json"));
  EXPECT_EQ(run["seed"], 5);
  EXPECT_EQ(run["recording"], 2);
  EXPECT_EQ(run["log_evidence"], summary["log_evidence"]);
  EXPECT_NEAR(std::sqrt(run["mse_truth"].get<double>()), summary["rmse"]["level"].get<double>(), 1e-9);
}

TEST(Compare, TakesARecordingOfOnesOwn) {
  const Scratch scratch;
  const Ended ended = scratch.shell(
      "mote simulate bearings --steps 12 --out d.csv --truth t.csv && mote compare bearings --data d.csv --truth t.csv "
      "--filters sisr -n 500 --repeats 2 --reference 'sisr -n 5000' --lost-beyond 1e-9 --json r.json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json json = Json::parse(scratch.read("r.json"));
  EXPECT_EQ(json["reference"]["name"], "sisr -n 5000");
  EXPECT_EQ(json["reference"]["exact"], false);
  EXPECT_EQ(json["state"], "position");
  EXPECT_EQ(json["results"][0]["lost"], 2);
  EXPECT_NE(ended.out.find("The reference has seed 3; its own Monte-Carlo error"), std::string::npos) << ended.out;
  const Ended alone = scratch.shell("mote compare bearings --data d.csv --filters sisr --repeats 2 --state vx");
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_NE(alone.out.find("reference: sisr -n 200000"), std::string::npos);
  EXPECT_EQ(alone.out.find("RMSE"), std::string::npos) << "there is no truth";
}

struct Refusal {
  std::string name, words;
  int code;
  std::string sentence;
};

std::ostream& operator<<(std::ostream& out, const Refusal& r) { return out << r.name; }

class CompareRefuses : public ::testing::TestWithParam<Refusal> {};

TEST_P(CompareRefuses, InOneSentence) {
  const Refusal& c = GetParam();
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1100\n2,1000\n");
  const auto before = scratch.files();
  const Ended ended = scratch.shell("mote compare " + c.words + " --out t.csv --json r.json --report r.html");
  EXPECT_EQ(ended.code, c.code) << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_TRUE(std::regex_search(ended.err, std::regex(c.sentence))) << ended.err;
  EXPECT_TRUE(std::regex_match(ended.err, std::regex(R"(^[^\n]+: expected [^\n]+, got [^\n]+\. [A-Z][^\n]+[.?]\n$)")) ||
              c.code == 4)
      << ended.err;
  EXPECT_EQ(scratch.files(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Doors, CompareRefuses,
    ::testing::Values(
        Refusal{"NoFilters", "ungm", 2, "--filters: expected filters with their options, separated by ;, got nothing"},
        Refusal{"OnlySeparators", "ungm --filters ' ; '", 2, "--filters: expected filters .*, got none"},
        Refusal{"UnknownFilter", "ungm --filters 'sisr; sis'", 2, "--filters: sis: --filter: .*Did you mean sisr"},
        Refusal{"UnknownOption", "ungm --filters 'imh --chans 4'", 2,
                R"(^mote compare: --filters: imh --chans 4: expected an option of mote run, got "--chans"\. Did you)"},
        Refusal{"OptionOfAnotherFilter", "ungm --filters 'sisr --improved'", 2, "--improved: expected --filter imh"},
        Refusal{"OwnParticles", "ungm --filters 'sisr -n 5'", 2, "--particles: expected one for all, .*got 5"},
        Refusal{"OwnSeed", "ungm --filters 'sisr --seed 5'", 2, "--seed: expected one for all"},
        Refusal{"ChainsBeyondParticles", "ungm -n 4,100 --filters 'imh --chains 5'", 2, "--chains: expected.*got 5"},
        Refusal{"UnknownProposal", "ungm --filters 'sisr --proposal no'", 2,
                "--filters: sisr --proposal no: --proposal: expected one of the model's"},
        Refusal{"ParticlesOfWords", "ungm --filters sisr -n 10,many", 2,
                R"(--particles: expected integers from 1 to 268435456, separated by commas, got "10,many")"},
        Refusal{"NoParticles", "ungm --filters sisr -n 0", 2, "--particles: expected integers"},
        Refusal{"NoRepeats", "ungm --filters sisr --repeats 0", 2, "--repeats: expected an integer from 1 to 10000"},
        Refusal{"NoRecordings", "ungm --filters sisr --recordings 0", 2, "--recordings: expected an integer"},
        Refusal{"StepsOfData", "local-level --data d.csv --steps 5 --filters sisr", 2,
                "--steps: expected simulated recordings, got --data"},
        Refusal{"TruthAlone", "local-level --truth d.csv --filters sisr", 2, "--truth: expected --data"},
        Refusal{"NothingToJudgeBy", "local-level --data d.csv --reference none --filters sisr", 2,
                "--reference none: expected a truth of level, got none"},
        Refusal{"LostFromWhat", "local-level --data d.csv --lost-beyond 3 --filters sisr", 2,
                "--lost-beyond: expected"},
        Refusal{"NothingExact", "doa --reference exact --filters sisr", 2,
                "--reference exact: expected a model .*exact solution, got doa"},
        Refusal{"UnknownReference", "doa --reference sis --filters sisr", 2, "--reference: sis: --filter: expected"},
        Refusal{"UnknownState", "ungm --state z --filters sisr", 2, R"(--state: expected one of x, got "z")"},
        Refusal{"UnknownModel", "ugm --filters sisr", 2, "MODEL: expected one of"},
        Refusal{"NoData", "ungm --data no.csv --filters sisr", 3, "no.csv: expected a file"},
        Refusal{"OutputOverTheData", "local-level --filters sisr --data t.csv", 3, "t.csv: expected a file"}),
    [](const auto& test) { return test.param.name; });

TEST(Compare, EndsCleanlyByCtrlC) {
  const Scratch scratch;
  Child child(scratch, {"compare", "ungm", "--filters", "sisr", "-n", "1000000", "--reference", "none", "--out",
                        "t.csv", "--json", "r.json", "--report", "r.html"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  child.signal(SIGINT);
  const auto end = child.end();
  EXPECT_EQ(end.code, 130) << end.err;
  EXPECT_TRUE(std::regex_match(
      end.err, std::regex("mote compare: interrupted after [0-9]+ of 200 runs; no file was written.\n")))
      << end.err;
  EXPECT_TRUE(scratch.files().empty());
}

}  // namespace
}  // namespace mote::testing

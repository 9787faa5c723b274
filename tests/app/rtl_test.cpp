// mote rtl: a model's filter as a circuit, from the model to what stands in the folder.

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/app/files/table.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

constexpr const char* kKeys[] = {
    "cycles", "predicted_cycles", "compared",  "mismatches", "lut",         "ff",
    "dsp",    "bram18",           "iob",       "fmax_mhz",   "sta_ns",      "device",
    "rmse",   "power_mw",         "switching", "stages",     "uj_per_step", "milliseconds"};

void expect_done(const Ended& ended) { EXPECT_EQ(ended.code, 0) << ended.err; }

TEST(Rtl, SaysWithNullsWhatWasNotAskedFor) {
  const Scratch scratch;
  expect_done(scratch.shell("mote rtl local-level --json j.json"));
  const Json json = Json::parse(scratch.read("j.json"));
  EXPECT_EQ(json.size(), std::size(kKeys));
  for (const char* key : kKeys) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json[key].is_null(), std::string(key) != "stages") << key;
  }
}

// claim    the simulated circuit equals its golden model, filters as well as the double filter, and tells the evidence
// referee  mote run on the same recording: rmse and log evidence of N = 500, which chance moves by a few per cent
// design   growth model, 40 steps, a gap and a step that was not seen; all kinds of filter
TEST(Rtl, SimulatesARecording) {
  const Scratch scratch;
  expect_done(
      scratch.shell("mote simulate ungm --steps 42 --seed 8 --out all.csv --truth truth.csv && "
                    "sed -e '/^7,/d' -e 's/^9,.*/9,/' all.csv > obs.csv"));
  expect_done(scratch.shell("mote run ungm --data obs.csv --truth truth.csv -n 20000 --summary run.json"));
  const Json referee = Json::parse(scratch.read("run.json"));
  for (const std::string arch : {"imh", "sisr", "imh-chain --lanes 4 --overlap", "auxiliary --proposal observation"}) {
    expect_done(scratch.shell("mote rtl ungm --arch " + arch +
                              " -n 500 --simulate obs.csv --truth truth.csv --json j.json --out d"));
    const Json json = Json::parse(scratch.read("j.json"));
    EXPECT_EQ(json["compared"], 42 * 500);
    EXPECT_EQ(json["mismatches"], 0);
    EXPECT_EQ(json["cycles"], json["predicted_cycles"]);
    EXPECT_LT(json["rmse"]["x"], 1.15 * referee["rmse"]["x"].get<double>());
    std::istringstream estimates(scratch.read("d/estimates.csv"));
    std::string line;
    std::getline(estimates, line);
    EXPECT_EQ(line, arch == "sisr" ? "t,x_mean,log_evidence" : "t,x_mean,log_evidence,acceptance");
    double evidence = 0;
    int rows = 0;
    for (; std::getline(estimates, line); ++rows) {
      std::istringstream fields(line);
      std::string t, mean, step;
      std::getline(std::getline(std::getline(fields, t, ','), mean, ','), step, ',');
      if (t == "9") {
        EXPECT_EQ(std::stod(step), 0);
      }
      evidence += std::stod(step);
    }
    EXPECT_EQ(rows, 41);
    EXPECT_NEAR(evidence, referee["log_evidence"].get<double>(), 6) << arch;
  }
}

// claim    a circuit whose costly operators take turns gives the estimates of the one whose do not, byte by byte, and
// equals its
//          golden model in cycles too: K clocks a proposal
// referee  the same command without --ii; the latency law, of which only the rows' clocks differ beside the pipelines'
TEST(Rtl, TakesTurnsAtWhatIsCostly) {
  const Scratch scratch;
  expect_done(scratch.shell("mote simulate ungm --set copies=2 --steps 12 --seed 4 --out obs.csv"));
  for (const std::string arch : {"imh", "sisr"}) {
    const std::string words =
        "mote rtl ungm --set copies=2 -n 100 --arch " + arch + " --simulate obs.csv --json j.json";
    expect_done(scratch.shell(words + " --out apart"));
    const Json apart = Json::parse(scratch.read("j.json"));
    expect_done(scratch.shell(words + " --ii 3 --out turns"));
    const Json turns = Json::parse(scratch.read("j.json"));
    EXPECT_EQ(turns["compared"], 12 * 100 * 2) << "words: a particle has two states";
    EXPECT_EQ(turns["mismatches"], 0);
    EXPECT_EQ(turns["cycles"], turns["predicted_cycles"]);
    EXPECT_EQ(scratch.read("turns/estimates.csv"), scratch.read("apart/estimates.csv"));
    if (arch == "imh") {
      EXPECT_EQ(turns["cycles"].get<int>() - apart["cycles"].get<int>(),
                12 * (2 * 99 + turns["stages"].get<int>() - apart["stages"].get<int>()));
    }
    const Ended passed = scratch.shell("sh turns/golden/run.sh && sh turns/testbench/run.sh");
    EXPECT_EQ(passed.code, 0) << passed.err << passed.out;
  }
}

// claim    words hold what is played: inputs that the model does not draw, steps further on than those that it draws, a
//          likelihood that it cannot draw from; and any units
// referee  mote run on the same recording, N = 20 000; the estimates of N = 300 are near its mean
// design   a range from a sensor that moves 100 m, a walk that goes 300 in 600 steps, Student-t errors without a law,
//          lengths of 2e7 and of 1e-4, a push that begins at t = 21, a heading that passes half a turn
class RtlOfTexts : public ::testing::Test {
 protected:
  /// Differences count up to multiples of `turn`, if it is not 0.
  void expect_near_the_double_filter(const std::string& model, double within, double turn = 0) const {
    const std::string name = model + ".toml";
    expect_done(scratch_.shell("mote run " + name + " --data d.csv -n 20000 --out run.csv"));
    expect_done(
        scratch_.shell("mote rtl " + name + " --arch sisr -n 300 --simulate d.csv --json j.json --out " + model));
    EXPECT_EQ(Json::parse(scratch_.read("j.json"))["mismatches"], 0);
    const Table run = read_table((scratch_.path() / "run.csv").string());
    const Table circuit = read_table((scratch_.path() / model / "estimates.csv").string());
    ASSERT_EQ(run.lines.size(), circuit.lines.size());
    double squares = 0;
    for (std::size_t i = 0; i < run.lines.size(); ++i) {
      const double difference = number_field(run, run.lines[i], 1) - number_field(circuit, circuit.lines[i], 1);
      squares += std::pow(turn == 0 ? difference : std::remainder(difference, turn), 2);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(run.lines.size())), within) << name;
  }

  Scratch scratch_;
};

TEST_F(RtlOfTexts, TakeInputsWhereTheDataHaveThem) {
  scratch_.write("moving.toml",
                 "[inputs]\nfrom = 0\n[states]\nx = \"normal(20, 5)\"\n[next]\nx = \"x + normal(0, 0.5)\"\n"
                 "[observations]\nrange = \"normal(sqrt((x - from)^2 + 25), 0.5)\"\n");
  std::string data = "t,range,from\n";
  for (int t = 1; t <= 40; ++t)
    data += fmt::format("{},{},{}\n", t, std::hypot(20 - 2.5 * t, 5) + 0.3 * std::sin(7 * t), 2.5 * t);
  scratch_.write("d.csv", data);
  expect_near_the_double_filter("moving", 0.3);
}

TEST_F(RtlOfTexts, GoFurtherThanTheModelDraws) {
  scratch_.write("walk.toml",
                 "[states]\nx = \"normal(0, 1)\"\n[next]\nx = \"x + 0.5 + normal(0, 1)\"\n[observations]\ny = "
                 "\"normal(x + 0.1*t, 1)\"\n");
  expect_done(scratch_.shell("mote simulate walk.toml --steps 600 --out d.csv"));
  expect_near_the_double_filter("walk", 0.2);
}

TEST_F(RtlOfTexts, HaveAnyUnits) {
  scratch_.write("far.toml",
                 "[states]\nx = \"normal(0, 500)\"\n[next]\nx = \"x + normal(0, 20)\"\n[observations]\n"
                 "range = \"normal(sqrt((x - 1.5e7)^2 + 4e14), 10)\"\n");
  expect_done(scratch_.shell("mote simulate far.toml --steps 30 --out d.csv"));
  expect_near_the_double_filter("far", 3);
  scratch_.write("small.toml",
                 "[states]\nx = \"normal(1e-4, 3e-5)\"\n[next]\nx = \"x + normal(0, 1e-5)\"\n[observations]\n"
                 "y = \"normal(sqrt(x^2 + 1e-8), 1e-5)\"\n");
  expect_done(scratch_.shell("mote simulate small.toml --steps 30 --out d.csv"));
  expect_near_the_double_filter("small", 2e-6);
  // a height that gravity holds, by 1/r^3 in metres, some 3e-21; without its pull the filter is off by far more than an
  // observation's error
  scratch_.write("orbit.toml",
                 "[states]\nr = \"normal(7e6, 2000)\"\nv = \"normal(50, 20)\"\n[next]\nr = \"r + 10*v\"\n"
                 "v = \"v + 3.986e15*(1/r^3*7e6 - 1/r^2) + 0.5*normal(0, 1)\"\n[observations]\n"
                 "height = \"normal(r - 6.371e6, 100)\"\n");
  expect_done(scratch_.shell("mote simulate orbit.toml --steps 30 --out d.csv"));
  expect_near_the_double_filter("orbit", 100);
}

TEST_F(RtlOfTexts, ChangeAtSomeStep) {
  scratch_.write("step.toml",
                 "[states]\nx = \"normal(0, 1)\"\n[next]\nx = \"0.9*x + 2*min(1, max(0, t - 20)) + normal(0, 0.5)\"\n"
                 "[observations]\ny = \"normal(x, 1)\"\n");
  expect_done(scratch_.shell("mote simulate step.toml --steps 50 --out d.csv"));
  expect_near_the_double_filter("step", 0.2);
}

TEST_F(RtlOfTexts, GoRoundWithAngles) {
  scratch_.write("heading.toml",
                 "[states]\nh = \"normal(2, 0.1)\"\n[next]\nh = \"wrap(h + 0.1 + normal(0, 0.05))\"\n[observations]\n"
                 "c = \"normal(cos(h), 0.2)\"\ns = \"normal(sin(h), 0.2)\"\n");
  expect_done(scratch_.shell("mote simulate heading.toml --steps 30 --out d.csv"));
  expect_near_the_double_filter("heading", 0.03, 2 * std::numbers::pi);
}

// claim    particles that run away, of a model that is unstable from somewhere on, do not make words wide
// referee  the words of the same model with a prior from which none do
TEST_F(RtlOfTexts, LeaveOutParticlesThatRunAway) {
  const auto words = [&](const char* highest) {
    scratch_.write("power.toml", fmt::format("[states]\nx = \"uniform(0.5, {})\"\n[next]\nx = \"abs(0.9*x^1.7 + 0.1*"
                                             "normal(0, 1)) + 0.1\"\n[observations]\ny = \"normal(x, 0.2)\"\n",
                                             highest));
    const Ended ended = scratch_.shell("mote rtl power.toml");
    expect_done(ended);
    const std::size_t at = ended.out.find("states of ");
    EXPECT_NE(at, std::string::npos) << ended.out;
    return at == std::string::npos ? 1000 : std::stoi(ended.out.substr(at + 10));
  };
  EXPECT_LE(words("1.2"), words("0.8") + 8);
}

TEST_F(RtlOfTexts, AreRefusedWhereAWordWouldBeTooWide) {
  scratch_.write("far.toml",
                 "[states]\nx = \"normal(2e7, 1)\"\n[next]\nx = \"x + normal(0, 1e-3)\"\n[observations]\n"
                 "y = \"normal(x, 0.01)\"\n");
  const Ended refused = scratch_.shell("mote rtl far.toml");
  EXPECT_EQ(refused.code, 2);
  for (const char* fact : {"states of far", "at most 29 bits", "x s", "the difference to a constant"})
    EXPECT_NE(refused.err.find(fact), std::string::npos) << refused.err;
}

TEST_F(RtlOfTexts, NeedNoLawWhereARecordingIsPlayed) {
  scratch_.write("heavy.toml",
                 "[states]\nx = \"normal(0, 1)\"\n[next]\nx = \"x + 0.3*normal(0, 1)\"\n[observations]\n"
                 "log_likelihood = \"-2*log(1 + ((y - x)/0.5)^2/3)\"\n");
  std::string data = "t,y\n";
  for (int t = 1; t <= 40; ++t)
    data += fmt::format("{},{}\n", t, std::sin(0.2 * t) + 0.4 * std::sin(7 * t) + (t == 20 ? 9 : 0));
  scratch_.write("d.csv", data);
  expect_near_the_double_filter("heavy", 0.1);
  const Ended refused = scratch_.shell("mote rtl heavy.toml --arch sisr -n 300");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("Pass --simulate obs.csv"), std::string::npos) << refused.err;
}

TEST(Rtl, WritesAFolderWhoseTestbenchPasses) {
  const Scratch scratch;
  expect_done(scratch.shell("mote rtl local-level --arch sisr -n 60 --out d"));
  for (const char* file : {"README.md", "circuit.json", "vivado.tcl", "mote_local_level_sisr.xdc",
                           "rtl/mote_local_level_sisr.sv", "rtl/mote_sisr.sv", "testbench/testbench.sv"})
    EXPECT_FALSE(scratch.read(std::string("d/") + file).empty()) << file;
  const Ended passed = scratch.shell("sh d/testbench/run.sh");
  EXPECT_EQ(passed.code, 0) << passed.err;
  EXPECT_NE(passed.out.find("PASSED: 20 estimates, 1200 particles"), std::string::npos) << passed.out;
  // the twin: one bit of one particle
  scratch.shell("sed -i '5s/.$/x/; 5y/0123456789abcdefx/1032547698badcfe0/' d/testbench/particles.hex");
  const Ended failed = scratch.shell("sh d/testbench/run.sh");
  EXPECT_NE(failed.code, 0) << failed.out;
}

TEST(Rtl, WritesATestbenchForRegistersOnABus) {
  const Scratch scratch;
  expect_done(scratch.shell("mote rtl local-level --arch imh -n 60 --burn-in 3 --registers axi-lite --out d"));
  EXPECT_NE(scratch.read("d/README.md").find("| 0x0c | `draws` |"), std::string::npos);
  const Ended passed = scratch.shell("sh d/testbench/run.sh");
  EXPECT_EQ(passed.code, 0) << passed.err;
  EXPECT_NE(passed.out.find("PASSED: 20 estimates, 1200 particles"), std::string::npos) << passed.out;
}

// claim    the golden model in C gives every word that the golden model in C++ gives, for every kind of filter
// design   all operators: tables, products, quotients and logarithms (bearings), sines by tables (doa); two states
// (ungm) twin     one bit of one particle
TEST(Rtl, WritesItsGoldenModelInC) {
  const Scratch scratch;
  int designs = 0;
  const auto passes = [&](const std::string& words) {
    const std::string folder = "d" + std::to_string(++designs);
    expect_done(scratch.shell("mote rtl " + words + " --out " + folder));
    const Ended passed = scratch.shell("CFLAGS=-Werror sh " + folder + "/golden/run.sh");
    EXPECT_EQ(passed.code, 0) << words << passed.err << passed.out;
    EXPECT_TRUE(passed.out.starts_with("PASSED: 20 estimates, ")) << words << passed.out;
    return folder;
  };
  const std::string says = scratch.shell("mote rtl local-level --arch none").err;
  std::istringstream kinds(says.substr(says.find("one of ") + 7));
  for (std::string kind; std::getline(kinds >> std::ws, kind, ',') && !kind.starts_with("got");)
    passes("local-level -n 3000 --arch " + kind);
  passes("ungm --arch auxiliary --proposal observation --overlap -n 200 --burn-in 7");
  passes("local-level --arch imh-chain --lanes 4 --overlap -n 40 --draws 80 --burn-in 3");
  passes("local-level --arch imh-chain --lanes 1 --overlap -n 24");
  passes("local-level --arch imh-parallel --overlap -n 24");
  for (const std::string scheme : {"residual-systematic", "roulette"}) {
    passes("local-level --arch sisr -n 100 --resampler " + scheme);
    passes("local-level --arch groups --exchange 9 -n 100 --resampler " + scheme);
  }
  expect_done(scratch.shell("mote rtl ungm --set copies=2 --instances 2 --arch sisr -n 60 --out x2"));
  for (const std::string golden : {"golden0", "golden1"})
    EXPECT_TRUE(scratch.shell("sh x2/" + golden + "/run.sh").out.starts_with("PASSED: 20 estimates, ")) << golden;
  passes("ungm --set copies=2 -n 200 --draws 300 --burn-in 20 --chain-mean");
  passes("doa --columns 2 --arch sisr-lanes -n 200");
  const std::string folder = passes("bearings --arch sisr -n 150");
  scratch.shell("sed -i '5s/.$/x/; 5y/0123456789abcdefx/1032547698badcfe0/' " + folder + "/testbench/particles.hex");
  const Ended failed = scratch.shell("sh " + folder + "/golden/run.sh");
  EXPECT_EQ(failed.code, 1) << failed.out;
  EXPECT_EQ(failed.out, "FAILED: 20 estimates, 3000 writes of the particle memory, 1 differ\n");
}

/// The covariance of the vectors that a testbench's stream holds: words of 18 bits, a line each.
std::array<double, 3> covariance_of(const std::string& lines, double step) {
  std::istringstream text(lines);
  std::array<double, 3> sums{};
  double count = 0;
  for (std::string line; std::getline(text, line); ++count) {
    const std::uint64_t word = std::stoull(line, nullptr, 16);
    const auto at = [&](unsigned bit) {
      return step * static_cast<double>(static_cast<std::int64_t>(word << (46 - bit)) >> 46);
    };
    sums[0] += at(0) * at(0);
    sums[1] += at(0) * at(18);
    sums[2] += at(18) * at(18);
  }
  for (double& sum : sums) sum /= count;
  return sums;
}

// claim    each part by itself gives its golden model's words, with streams that pause by chance
// referee  of the normal vectors besides: the covariance asked for, 4, 1, 2, within 5 standard errors of 1000 vectors
// twin     one bit of one word
TEST(Rtl, WritesPartsBetweenStreams) {
  const Scratch scratch;
  const auto passes = [&](const std::string& words, const std::string& folder, const std::string& says) {
    expect_done(scratch.shell("mote rtl " + words + " --out " + folder));
    const Ended passed = scratch.shell("sh " + folder + "/testbench/run.sh");
    EXPECT_EQ(passed.code, 0) << words << passed.err << passed.out;
    EXPECT_NE(passed.out.find(says), std::string::npos) << passed.out;
  };
  passes("--accelerator gaussian --covariance '4,1;1,2'", "g", "PASSED: 1000 words");
  passes("--accelerator resampler -n 50", "r", "PASSED: 400 words");
  passes("ungm --accelerator likelihood -n 40", "l", "PASSED: 800 words");
  const auto covariance = covariance_of(scratch.read("g/testbench/normal.hex"), std::ldexp(1.0, -13));
  EXPECT_NEAR(covariance[0], 4, 5 * 4 * std::sqrt(2.0 / 1000));
  EXPECT_NEAR(covariance[1], 1, 5 * std::sqrt(9.0 / 1000));
  EXPECT_NEAR(covariance[2], 2, 5 * 2 * std::sqrt(2.0 / 1000));
  scratch.shell("sed -i '7s/.$/x/; 7y/0123456789abcdefx/1032547698badcfe0/' r/testbench/parent.hex");
  EXPECT_NE(scratch.shell("sh r/testbench/run.sh").code, 0);
}

TEST(Rtl, KeepsWhatOthersWrote) {
  const Scratch scratch;
  scratch.shell("mkdir d && echo mine > d/README.md");
  const Ended refused = scratch.shell("mote rtl local-level -n 20 --out d");
  EXPECT_EQ(refused.code, 6);
  EXPECT_NE(refused.err.find("a file README.md of something else"), std::string::npos) << refused.err;
  EXPECT_EQ(scratch.read("d/README.md"), "mine\n");
  expect_done(scratch.shell("mote rtl local-level -n 20 --out e && mote rtl local-level -n 30 --out e"));
}

struct Wrong {
  const char* words;
  int code;
  const char* says;
};

TEST(Rtl, RefusesInASentence) {
  const Scratch scratch;
  scratch.write("twice.csv", "t,y\n1,2\n1,3\n");
  scratch.write("one.csv", "t,y\n1,2\n");
  const Wrong all[] = {
      {"local-level --arch fir", 2, "--arch: expected one of imh, imh-parallel, imh-chain, auxiliary, sisr"},
      {"local-level --arch sisr --burn-in 3", 2, "--burn-in: expected an architecture that has it, got sisr"},
      {"local-level --lanes 2", 2, "--lanes: expected an architecture that has it"},
      {"local-level --arch sisr --overlap", 2, "--overlap: expected an architecture that has it, got sisr"},
      {"local-level --ii 0", 2, "--ii: expected an integer from 1 to 16, got 0"},
      {"local-level --arch groups --ii 2", 2, "--ii: expected an architecture that has it, got groups"},
      {"local-level --overlap --ii 2", 2, "--ii: expected 1 with --overlap, got 2"},
      {"--accelerator resampler --ii 2", 2, "--ii: expected nothing with --accelerator resampler"},
      {"local-level --proposal optimal", 2, "--proposal: expected an architecture that has it, got imh"},
      {"local-level --arch auxiliary --proposal none", 2, "--proposal: expected one of the model's proposals"},
      {"local-level --arch sisr-lanes -n 99", 2, "--lanes: expected a power of two from 1 to 8 that divides"},
      {"local-level --arch imh --resampler roulette", 2, "--resampler: expected an architecture that has it, got imh"},
      {"local-level --arch sisr-lanes --resampler roulette", 2, "--resampler: expected an architecture that has it"},
      {"local-level --arch sisr --resampler residual", 2,
       "--resampler: expected one of systematic, residual-systematic, roulette"},
      {"local-level --arch sisr --loops merged", 2, "--loops: expected an architecture that has it, got sisr"},
      {"local-level --arch sisr --exchange 1", 2, "--exchange: expected an architecture that has it, got sisr"},
      {"local-level --arch groups -n 100 --lanes 4 --exchange 26", 2, "--exchange: expected an integer from 0 to 25"},
      {"local-level -n 100 --draws 50", 2, "--draws: expected an integer from 100 to 65536"},
      {"local-level -n 0", 2, "--particles: expected an integer from 1 to 65536"},
      {"--accelerator fir", 2, "--accelerator: expected one of gaussian, likelihood, resampler"},
      {"--accelerator likelihood", 2, "MODEL: expected a model"},
      {"local-level --accelerator gaussian", 2, "MODEL: expected nothing with --accelerator gaussian"},
      {"--accelerator gaussian --covariance '1,2;2,1'", 2, "covariance: expected a positive definite matrix"},
      {"--accelerator gaussian --covariance '1,2'", 2, "--covariance: expected a symmetric matrix"},
      {"--accelerator resampler --simulate one.csv", 2, "--simulate: expected nothing with --accelerator resampler"},
      {"local-level --covariance 2", 2, "--covariance: expected --accelerator gaussian"},
      {"", 2, "MODEL: expected a model"},
      {"local-level --registers spi", 2, "--registers: expected one of ports, axi-lite"},
      {"local-level --synth asic", 2, "--synth: expected one of xc7, ice40, ecp5"},
      {"local-level --truth one.csv", 2, "--truth: expected --simulate"},
      {"local-level --simulate twice.csv", 3,
       "twice.csv: t = 1: expected one row a step, which a circuit takes, got 2"},
      {"local-level --simulate none.csv", 3, "none.csv"},
      {"nothing", 2, "nothing"}};
  for (const Wrong& wrong : all) {
    const Ended ended = scratch.shell(std::string("mote rtl ") + wrong.words);
    EXPECT_EQ(ended.code, wrong.code) << wrong.words << ": " << ended.err;
    EXPECT_NE(ended.err.find(wrong.says), std::string::npos) << ended.err;
  }
  const Ended missing = scratch.shell("PATH=/nowhere mote rtl local-level --simulate one.csv");
  EXPECT_EQ(missing.code, 5);
  EXPECT_NE(missing.err.find("apt-get install verilator"), std::string::npos) << missing.err;
  EXPECT_EQ(scratch.shell("PATH=/nowhere mote rtl local-level --synth xc7").code, 5);
}

TEST(Rtl, CountsWhatACircuitTakes) {
  const Scratch scratch;
  expect_done(scratch.shell("mote simulate local-level --steps 5 --out obs.csv"));
  expect_done(scratch.shell("mote rtl local-level --arch sisr -n 250 --simulate obs.csv --synth xc7 --json j.json"));
  const Json json = Json::parse(scratch.read("j.json"));
  EXPECT_GT(json["lut"], 500);
  EXPECT_GT(json["ff"], 500);
  EXPECT_GT(json["bram18"], 0);
  EXPECT_GT(json["iob"], 100);
  EXPECT_TRUE(json["device"].get<std::string>().starts_with("XC7A100T"));
  EXPECT_GT(json["fmax_mhz"], 50);
  EXPECT_LT(json["fmax_mhz"], 400);
  EXPECT_NEAR(json["milliseconds"].get<double>() * json["fmax_mhz"].get<double>() * 1000, json["cycles"].get<double>(),
              1e-6);
  EXPECT_GT(json["switching"], 0.02);
  EXPECT_LT(json["switching"], 0.5);
  EXPECT_NEAR(json["uj_per_step"].get<double>() * 5,
              json["power_mw"].get<double>() * json["milliseconds"].get<double>(), 1e-9);
}

// claim    circuits of logic alone, as they are made for a device without multipliers, and steps that are shorter than
// the
//          window of --overlap, equal their golden models, word for word and cycle for cycle
// referee  the golden model; tools that only say a cell and a clock stand in for synthesis, which is not what is asked
TEST(Rtl, MakesCircuitsOfLogicWithTheirGoldenModels) {
  const Scratch scratch;
  scratch.shell("mkdir bin");
  scratch.write("bin/yosys", "#!/bin/sh\nstat=${3##*tee -o }\necho 'Number of cells: 1' >\"${stat%% *}\"\n");
  scratch.write("bin/nextpnr-ice40",
                "#!/bin/sh\nwhile [ \"$1\" != --log ]; do shift; done\n"
                "echo \"Max frequency for clock 'clk': 90.5 MHz\" >\"$2\"\n");
  expect_done(scratch.shell("chmod +x bin/* && mote simulate ungm --steps 12 --seed 3 --out obs.csv"));
  for (const std::string words : {"--arch imh -n 5 --overlap", "--arch imh-parallel --lanes 4 -n 64 --chain-mean",
                                  "--arch sisr -n 100", "--arch sisr -n 100 --resampler residual-systematic",
                                  "--arch sisr -n 100 --resampler roulette", "--arch groups --lanes 4 -n 128"}) {
    expect_done(scratch.shell("PATH=\"$PWD/bin:$PATH\" mote rtl ungm " + words +
                              " --simulate obs.csv --synth ice40 --json j.json"));
    const Json json = Json::parse(scratch.read("j.json"));
    EXPECT_GT(json["compared"], 0) << words;
    EXPECT_EQ(json["mismatches"], 0) << words;
    EXPECT_EQ(json["cycles"], json["predicted_cycles"]) << words;
    EXPECT_EQ(json["fmax_mhz"], 90.5) << words;
  }
}

}  // namespace
}  // namespace mote::testing

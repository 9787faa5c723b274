// Files and help as the fixed doors say.

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/files/table.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

/// Rows of a CSV text as fields.
std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::stringstream text(csv);
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::stringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

TEST(Estimates, HaveOneRowPerDistinctTime) {
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n2,1\n2,2\n5,\n7,3\n");
  ASSERT_EQ(scratch.shell("mote run local-level --data d.csv --out e.csv").code, 0);
  const auto rows = rows_of(scratch.read("e.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1][0], "2");
  EXPECT_EQ(rows[2][0], "5");
  EXPECT_EQ(rows[3][0], "7");
  EXPECT_EQ(rows[2][4], "0") << "a step without observation says nothing about the model";
}

TEST(Particles, HaveWeightsThatSumToOneAndGiveTheMeans) {
  for (const std::string filter :
       {"sisr --ess-threshold 0.5", "imh --improved", "auxiliary", "distributed --groups 4", "sqmc", "ekf", "ukf"}) {
    const Scratch scratch;
    const Ended ended = scratch.shell(
        "mote simulate ungm --steps 8 --seed 2 --out d.csv && "
        "mote run ungm --data d.csv -n 64 --out e.csv --dump-particles p.csv --filter " +
        filter);
    ASSERT_EQ(ended.code, 0) << ended.err;
    std::map<std::string, std::array<double, 2>> sums;
    const auto particles = rows_of(scratch.read("p.csv"));
    ASSERT_EQ(particles[0], (std::vector<std::string>{"t", "x", "weight"}));
    for (std::size_t i = 1; i < particles.size(); ++i) {
      const double w = std::stod(particles[i][2]);
      sums[particles[i][0]][0] += w;
      sums[particles[i][0]][1] += w * std::stod(particles[i][1]);
    }
    const auto estimates = rows_of(scratch.read("e.csv"));
    ASSERT_EQ(estimates.size(), 9U);
    for (std::size_t k = 1; k < estimates.size(); ++k) {
      EXPECT_NEAR(sums[estimates[k][0]][0], 1, 1e-12) << filter;
      EXPECT_NEAR(sums[estimates[k][0]][1], std::stod(estimates[k][1]), 1e-9) << filter;
    }
  }
}

TEST(Summary, HasTheKeysOfTheDoor) {
  const Scratch scratch;
  const Ended ended = scratch.shell(
      "mote simulate bearings --steps 20 --out d.csv --truth t.csv && "
      "mote run bearings --data d.csv --truth t.csv --filter imh --summary s.json --report r.html");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json summary = Json::parse(scratch.read("s.json"));
  for (const std::string key :
       {"model", "filter", "engine", "particles", "seed", "steps", "log_evidence", "wall_seconds",
        "ns_per_particle_step", "mean_ess", "acceptance", "rmse", "collapses", "position_error"})
    EXPECT_TRUE(summary.contains(key)) << key;
  for (const std::string state : {"x", "vx", "y", "vy"}) EXPECT_TRUE(summary["rmse"].contains(state)) << state;
  for (const std::string key : {"mean", "median", "rmse"}) EXPECT_TRUE(summary["position_error"].contains(key)) << key;
  EXPECT_EQ(summary["steps"], 20);
  EXPECT_NE(scratch.read("r.html").find("run bearings"), std::string::npos) << "the command that makes it again";
}

TEST(Summary, NamesNothingThatIsNotThere) {
  const Scratch scratch;
  ASSERT_EQ(
      scratch.shell("mote simulate ungm --steps 5 --out d.csv && mote run ungm --data d.csv --summary s.json").code, 0);
  const Json summary = Json::parse(scratch.read("s.json"));
  std::set<std::string> keys;
  for (const auto& [key, value] : summary.items()) keys.insert(key);
  EXPECT_EQ(keys,
            (std::set<std::string>{"model", "filter", "engine", "particles", "seed", "steps", "predicted_steps",
                                   "log_evidence", "wall_seconds", "ns_per_particle_step", "mean_ess", "collapses"}));
}

TEST(Summary, SaysWhatGroupsSend) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate bearings --steps 6 --out d.csv").code, 0);
  const auto summary = [&](const std::string& options) {
    EXPECT_EQ(
        scratch.shell("mote run bearings --data d.csv -n 64 --filter distributed " + options + " --summary s.json")
            .code,
        0);
    return Json::parse(scratch.read("s.json"));
  };
  const Json torus = summary("--groups 16 --exchange append --topology torus --exchange-every 2");
  EXPECT_EQ(torus["messages_per_step"], 32) << "64 messages at every other step";
  EXPECT_EQ(torus["bytes_per_step"], 32 * 40);
  EXPECT_EQ(summary("--groups 16 --exchange append --precision float")["bytes_per_step"], 16 * 24);
  EXPECT_EQ(summary("--groups 1 --group-resampling rpa")["bytes_per_step"], 0);
  EXPECT_GE(summary("--groups 16 --group-resampling rpa")["bytes_per_step"], 16 * 15 * 8);
}

// Even after a collapse, whose evidence is -inf, the summary is JSON.
TEST(Summary, IsJsonAfterACollapse) {
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1e300\n2,1000\n");
  ASSERT_EQ(scratch.shell("mote run local-level --data d.csv --on-collapse keep --summary s.json").code, 0);
  const Json summary = Json::parse(scratch.read("s.json"));
  EXPECT_TRUE(summary["log_evidence"].is_null());
  EXPECT_EQ(summary["collapses"], 1);
}

TEST(Estimates, HaveTheColumnsOfTheDoor) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate doa --columns 2 --steps 3 --out d.csv").code, 0);
  const std::string states = "t,theta_mean,theta_sd,q_mean,q_sd,phi_mean,phi_sd,ess,log_evidence";
  const std::map<std::string, std::string> wanted{{"sisr", states + "\n"},
                                                  {"distributed --groups 2", states + "\n"},
                                                  {"sqmc", states + "\n"},
                                                  {"ekf", states + "\n"},
                                                  {"ukf --estimate 'q0.9(theta)'", states + ",q0.9(theta)\n"},
                                                  {"imh", states + ",acceptance\n"},
                                                  {"auxiliary", states + ",acceptance\n"},
                                                  {"imh --estimate 'q0.9(theta)' --estimate 'P(q<0)' --estimate phi",
                                                   states + ",acceptance,q0.9(theta),P(q<0),phi\n"},
                                                  {"sisr --estimate 'sd(q)'", states + ",sd(q)\n"}};
  for (const auto& [options, header] : wanted) {
    const Ended ended = scratch.shell("mote run doa --data d.csv --out - --filter " + options);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out.substr(0, ended.out.find('\n') + 1), header) << options;
    EXPECT_EQ(rows_of(ended.out).size(), 4U);
  }
}

TEST(Simulation, GivesTheSameBytesForTheSameSeed) {
  const Scratch scratch;
  const std::string doa = "mote simulate doa --columns 3 --steps 5 --seed 9 --out ";
  ASSERT_EQ(scratch.shell(doa + "a.csv --truth t.csv && " + doa + "b.csv && " + doa + "c.csv --seed 10").code, 0);
  EXPECT_EQ(scratch.read("a.csv"), scratch.read("b.csv"));
  EXPECT_NE(scratch.read("a.csv"), scratch.read("c.csv"));
  EXPECT_EQ(rows_of(scratch.read("a.csv"))[0], (std::vector<std::string>{"t", "doa1", "doa2", "doa3"}));
  EXPECT_EQ(rows_of(scratch.read("t.csv"))[0], (std::vector<std::string>{"t", "theta", "q", "phi"}));
  EXPECT_EQ(rows_of(scratch.read("a.csv")).size(), 6U);
}

// A recording that is read and written again is the same file: text loses no bit of a number.
TEST(Simulation, RoundTripsBitForBit) {
  const Scratch scratch;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.name == "linear-gaussian") continue;
    ASSERT_EQ(scratch.shell("mote simulate " + entry.name + " --steps 40 --seed 3 --out d.csv --truth t.csv").code, 0);
    const auto model = entry.make(Settings("test", {}), std::vector<std::string>{"t", "doa1"});
    const Simulation simulated = model->simulate(40, 3);
    const Table data = read_table(scratch.file("d.csv"));
    const Table truth = read_table(scratch.file("t.csv"));
    ASSERT_EQ(data.lines.size(), 40U);
    for (std::size_t k = 0; k < 40; ++k) {
      for (std::size_t j = 0; j < simulated.rows[k].values.size(); ++j)
        EXPECT_EQ(number_field(data, data.lines[k], j + 1), simulated.rows[k].values[j]) << entry.name;
      for (std::size_t d = 0; d < simulated.states[k].size(); ++d)
        EXPECT_EQ(number_field(truth, truth.lines[k], d + 1), simulated.states[k][d]) << entry.name;
    }
  }
}

TEST(Models, AreTheCatalogueOfTheDesign) {
  const Scratch scratch;
  const Json models = Json::parse(scratch.shell("mote models --json").out);
  const std::map<std::string, std::map<std::string, double>> wanted{
      {"ungm", {{"a", 0.5}, {"omega", 1.2}, {"q", 10}, {"r", 1}, {"p0", 5}, {"copies", 1}}},
      {"bearings",
       {{"period", 1},
        {"sigma_u", 0.001},
        {"sigma_r", 0.0488692},
        {"damping", 1},
        {"x0", 0.250},
        {"vx0", 0.001},
        {"y0", 0.240},
        {"vy0", -0.005},
        {"sd_x", 0.02},
        {"sd_vx", 0.002},
        {"sd_y", 0.02},
        {"sd_vy", 0.002},
        {"dof", 0},
        {"correlation", 0},
        {"distortion", 0},
        {"sigma_across", 0},
        {"cruise", 0}}},
      {"doa",
       {{"sigma_theta", 0.02},
        {"sigma_q", 0.005},
        {"sigma_phi", 0.05},
        {"sigma_o", 0.05},
        {"theta0", 0.5},
        {"q0", 0.05},
        {"phi0", 0.8},
        {"sd_theta", 0.2},
        {"sd_q", 0.02},
        {"sd_phi", 0.3},
        {"correlation", 0},
        {"dof", 0}}},
      {"local-level", {{"var_level", 1469.1}, {"var_obs", 15099}, {"level0", 1120}, {"p0", 1e5}}}};
  std::set<std::string> seen;
  for (const Json& model : models) {
    seen.insert(model["name"].get<std::string>());
    const auto found = wanted.find(model["name"].get<std::string>());
    if (found == wanted.end()) continue;
    std::map<std::string, double> given;
    for (const Json& p : model["parameters"]) given[p["name"]] = std::stod(p["default"].get<std::string>());
    EXPECT_EQ(given, found->second) << model["name"];
  }
  EXPECT_EQ(seen, (std::set<std::string>{"ungm", "bearings", "doa", "local-level", "linear-gaussian"}));
}

TEST(Models, AreShownAsTextToo) {
  const Scratch scratch;
  for (const Json& model : Json::parse(scratch.shell("mote models --json").out)) {
    const Ended shown = scratch.shell("mote models " + model["name"].get<std::string>());
    EXPECT_EQ(shown.code, 0);
    for (const Json& p : model["parameters"])
      EXPECT_NE(shown.out.find("  " + p["name"].get<std::string>() + " "), std::string::npos) << p["name"];
    for (const Json& s : model["states"]) EXPECT_NE(shown.out.find(s["name"].get<std::string>()), std::string::npos);
    const Json alone = Json::parse(scratch.shell("mote models " + model["name"].get<std::string>() + " --json").out);
    EXPECT_EQ(alone, model);
  }
}

// Every option says its default, that it must be given, or that this version does not have it.
TEST(Help, ShowsEveryOptionWithItsDefault) {
  const Scratch scratch;
  for (const Command& command : {models_command(), simulate_command(), run_command(nullptr), reproduce_command()}) {
    const Ended help = scratch.shell("mote " + command.name + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.err, "");
    for (const OptionSpec& option : command.options) {
      const std::size_t start = help.out.find("\n  " + option.flags);
      ASSERT_NE(start, std::string::npos) << option.flags;
      const std::string line = help.out.substr(start + 1, help.out.find('\n', start + 1) - start);
      const bool told = option.value.empty() || line.find('[') != std::string::npos ||
                        line.find("must be given") != std::string::npos ||
                        line.find("not in this version") != std::string::npos;
      EXPECT_TRUE(told || command.name == "reproduce") << line;
      if (!option.fallback.empty()) {
        EXPECT_NE(line.find("[" + option.fallback + "]"), std::string::npos) << line;
      }
    }
  }
}

TEST(Help, NamesTheOptionsOfTheDoor) {
  const Scratch scratch;
  const std::string help = scratch.shell("mote run --help").out;
  for (const std::string option :
       {"--data FILE",        "--truth FILE",         "--out FILE",         "--summary FILE",   "--report FILE",
        "--filter NAME",      "-n,--particles N",     "--seed S",           "--set NAME=VALUE", "--resampler NAME",
        "--ess-threshold X",  "--burn-in NB",         "--draws Q",          "--chains P",       "--parents HOW",
        "--chain-start HOW",  "--on-collapse WHAT",   "--engine NAME",      "--threads K",      "--precision TYPE",
        "--groups K",         "--exchange HOW",       "--exchange-count M", "--proposers R",    "--weighers R",
        "--checkpoint FILE",  "--checkpoint-every S", "--budget TIME",      "--estimate F",     "--dump-particles FILE",
        "--most-particles N", "--mc-error E",         "--bins W,W...",      "--improved",       "--topology NAME",
        "--exchange-every M", "--exchange-when X"})
    EXPECT_NE(help.find("\n  " + option), std::string::npos) << option;
  EXPECT_EQ(scratch.shell("mote --help").code, 0);
  EXPECT_EQ(scratch.shell("mote --version").code, 0);
}

}  // namespace
}  // namespace mote::testing

// Files as the fixed doors say, and the memory a run may take.

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "mote/base/numbers.hpp"
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
       {"sisr --ess-threshold 0.5", "imh --improved", "auxiliary", "distributed --groups 4"}) {
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

TEST(Simulation, RoundTripsBitForBit) {
  const Scratch scratch;
  ASSERT_EQ(scratch
                .shell("mote simulate doa --columns 3 --steps 5 --seed 9 --out a.csv --truth t.csv && "
                       "mote simulate doa --columns 3 --steps 5 --seed 9 --out b.csv")
                .code,
            0);
  EXPECT_EQ(scratch.read("a.csv"), scratch.read("b.csv"));
  EXPECT_EQ(rows_of(scratch.read("a.csv"))[0], (std::vector<std::string>{"t", "doa1", "doa2", "doa3"}));
  EXPECT_EQ(rows_of(scratch.read("t.csv"))[0], (std::vector<std::string>{"t", "theta", "q", "phi"}));
  EXPECT_EQ(rows_of(scratch.read("a.csv")).size(), 6U);
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
        {"dof", 0}}},
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
        {"sd_phi", 0.3}}},
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

TEST(Help, ShowsEveryOptionWithItsDefault) {
  const Scratch scratch;
  const Ended help = scratch.shell("mote run --help");
  EXPECT_EQ(help.code, 0);
  for (const std::string option :
       {"--data",           "--truth",     "--out",     "--summary",     "--report",         "--filter",
        "--particles",      "--seed",      "--set",     "--resampler",   "--ess-threshold",  "--burn-in",
        "--draws",          "--chains",    "--parents", "--chain-start", "--on-collapse",    "--engine",
        "--threads",        "--precision", "--groups",  "--exchange",    "--exchange-count", "--estimate",
        "--dump-particles", "--improved"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  EXPECT_NE(help.out.find("[1000]"), std::string::npos);
  EXPECT_EQ(scratch.shell("mote --version").code, 0);
}

/// Largest resident memory of a child that runs the line, bytes; other children of this process must be smaller.
double peak_of(const Scratch& scratch, const std::string& line) {
  const Ended ended = scratch.shell(
      "/usr/bin/env python3 -c 'import resource,subprocess,sys; code=subprocess.call(sys.argv[1:]); "
      "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(code)' '" MOTE_PROGRAM "' " +
      line + " | tail -1");
  return ended.code == 0 ? std::stod(ended.out) * 1024 : kNaN;
}

// claim    peak memory of a run is at most 64 bytes x N x states + 64 MB
// referee  the operating system's account of the child
TEST(Memory, StaysWithinItsBound) {
  const Scratch scratch;
  ASSERT_EQ(
      scratch.shell("mote simulate ungm --steps 3 --out u.csv && mote simulate bearings --steps 3 --out b.csv").code,
      0);
  const auto expect_within = [&](const std::string& model, const std::string& options, double n, double states) {
    const double peak =
        peak_of(scratch, "run " + model + " -n " + std::to_string(static_cast<long>(n)) + " " + options);
    EXPECT_LE(peak, 64 * n * states + 64e6) << model << " " << options << ": " << peak / n << " bytes a particle";
  };
  for (const std::string scheme :
       {"systematic", "stratified", "multinomial", "residual", "roulette", "alias", "metropolis", "rejection"})
    expect_within("ungm --data u.csv", "--resampler " + scheme, 1e6, 1);
  for (const std::string filter :
       {"imh", "imh --improved", "auxiliary --parent-weights lookahead", "distributed --groups 8 --exchange append",
        "sisr --precision float", "sisr --estimate q0.5\\(x\\)"})
    expect_within("ungm --data u.csv", "--filter " + filter, 1e6, 1);
  expect_within("bearings --data b.csv", "", 5e5, 4);
  expect_within("bearings --data b.csv", "--filter imh", 5e5, 4);
}

}  // namespace
}  // namespace mote::testing

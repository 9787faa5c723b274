#include "mote/app/compare/study.hpp"

#include <gtest/gtest.h>

#include "mote/app/compare/figures.hpp"
#include "mote/base/refusal.hpp"

namespace mote::compare {
namespace {

const std::atomic<bool> kNever{false};
const ProgressOf kQuiet = [](std::size_t, std::size_t) {};

Design design_of(const std::string& model, const std::string& filters, std::vector<std::size_t> particles,
                 std::size_t recordings, std::size_t repeats) {
  Design design;
  design.model = model;
  design.where = "test";
  design.catalogue_model = find_model(model, "test").make(Settings("test", {}), std::vector<std::string>{"doa1"});
  for (std::uint64_t k = 0; k < recordings; ++k)
    design.scenes.push_back(simulated_scene(*design.catalogue_model, 40, 11 + k));
  std::vector<std::string> notes;
  design.contenders = contenders_from(filters, particles, "test", notes);
  design.particles = std::move(particles);
  design.repeats = repeats;
  design.target = target_of("", design.catalogue_model->states(), "test");
  design.reference = exact_reference(design, kQuiet, kNever);
  return design;
}

// claim    runs are paired, so that equal contenders are equal bit by bit; more particles come nearer to the exact mean
// referee  the Kalman filter
// design   local-level, 4 recordings of 40 steps, 6 repeats, N = 50 and 800: the MSE falls by about 16
// risk     a factor of 5 is missed once in a million; the twin, another seed for the equal contender, must be caught
TEST(Study, PairsItsRunsAndSeesMoreParticlesComeNearer) {
  Design design = design_of("local-level", "sisr; sisr; imh", {50, 800}, 4, 6);
  ASSERT_TRUE(design.reference.exact);
  EXPECT_EQ(design.contenders[1].name, "sisr (2)");
  const auto runs = run_study(design, kQuiet, kNever);
  const auto figures = figures_of(design, runs, std::nullopt);
  for (std::size_t size = 0; size < 2; ++size) {
    EXPECT_EQ(figures[1][size].ratio->value, 1);
    EXPECT_EQ(figures[1][size].ratio->interval.low, 1);
    EXPECT_EQ(figures[1][size].ratio->interval.high, 1);
    EXPECT_FALSE(figures[0][size].ratio) << "not of itself";
    EXPECT_GT(figures[2][size].ratio->value, 1) << "imh as in the paper pays for its chain";
  }
  for (const auto& of : figures) EXPECT_GT(of[0].median_mse.value, 5 * of[1].median_mse.value);
  design.seed += 1000;
  const auto others = figures_of(design, {runs[0], run_study(design, kQuiet, kNever)[1]}, std::nullopt);
  EXPECT_NE(others[1][0].ratio->value, 1) << "the twin";
}

// claim    the filter's own measure of its error is right: NEES is about 1, about 95 % of the steps are covered
// referee  the truth behind simulated recordings of a Gaussian model
// design   local-level, 20 recordings of 40 steps, one run of 2000 particles each: NEES has a standard error of 0.07
// with
//          errors that last (about 300 independent ones)
// risk     [0.65, 1.35] is 5 of them; the twin, a filter that believes in a quarter of the noise, must be caught
TEST(Study, TellsACalibratedFilterFromOneThatClaimsTooMuch) {
  Design design = design_of("local-level", "sisr", {2000}, 20, 1);
  Figures f = figures_of(design, run_study(design, kQuiet, kNever), std::nullopt)[0][0];
  EXPECT_GT(f.nees, 0.65);
  EXPECT_LT(f.nees, 1.35);
  EXPECT_NEAR(f.coverage, 0.95, 0.04);
  EXPECT_LT(f.nees_band.low, 1);
  EXPECT_GT(f.nees_band.high, 1);
  design.catalogue_model =
      find_model("local-level", "test").make(Settings("test", {"var_obs=1500"}), std::vector<std::string>{});
  f = figures_of(design, run_study(design, kQuiet, kNever), std::nullopt)[0][0];
  EXPECT_GT(f.nees, 1.35) << "the twin";
  EXPECT_LT(f.coverage, 0.9) << "the twin";
}

TEST(Study, CountsCollapsedAndLostRuns) {
  Design design = design_of("ungm", "sisr", {5}, 2, 3);
  design.scenes[1].recording.steps[4].rows[0].values[0] = 1e300;  // no particle explains it
  const auto runs = run_study(design, kQuiet, kNever);
  const Figures f = figures_of(design, runs, 1e-9)[0][0];
  EXPECT_EQ(runs[0][0].size(), 6U);
  EXPECT_EQ(f.collapsed, 3U) << "the runs on one recording";
  EXPECT_EQ(f.lost, 6U) << "nobody ends so near";
  EXPECT_EQ(f.mean_mse.value, kInfinity);
  EXPECT_EQ(f.median_mse.value, kInfinity) << "half of the runs";
  EXPECT_EQ(f.log_evidence, -kInfinity);
  EXPECT_GT(f.seconds, 0) << "of the others";
  EXPECT_EQ(figures_of(design, runs, 1e9)[0][0].lost, 3U);
}

TEST(Study, EndsWhenItIsTold) {
  const Design design = design_of("local-level", "sisr", {10}, 1, 5);
  std::atomic<bool> stop{false};
  try {
    run_study(
        design, [&](std::size_t done, std::size_t) { stop = done == 20; }, stop);
    FAIL() << "nothing stopped it";
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kInterrupted);
    EXPECT_STREQ(refusal.what(), "test: interrupted after 2 of 5 runs; no file was written.");
  }
}

// Correlated states by hand: deviations 1 and 2, correlation 0.5; e = (1, 0): e' P^-1 e = 1 / (1 - 0.25).
TEST(NormalisedError, OfACorrelatedPair) {
  Particles<double> x(2, 4);
  const double a[4] = {1, 1, -1, -1};
  const double b[4] = {1, -1, 1, -1};
  for (std::size_t i = 0; i < 4; ++i) {
    x.component(0)[i] = a[i];
    x.component(1)[i] = 2 * (0.5 * a[i] + std::sqrt(0.75) * b[i]);
  }
  const std::vector<double> weights(4, 1.0);
  const WeightedSet set{&x, weights, 4};
  const std::vector<double> truth{-1, 0};
  const Nees nees = normalised_error(set, {{"a", ""}, {"b", ""}}, truth);
  EXPECT_NEAR(nees.value, 1 / 0.75, 1e-12);
  EXPECT_EQ(nees.degrees_of_freedom, 2);
  const std::vector<double> partly{-1, kNaN};
  EXPECT_NEAR(normalised_error(set, {{"a", ""}, {"b", ""}}, partly).value, 1, 1e-12);
}

TEST(NormalisedError, WrapsAnglesAndLeavesOutWhatDoesNotSpread) {
  Particles<double> x(2, 2);
  x.component(0)[0] = kPi - 0.1;
  x.component(0)[1] = -kPi + 0.1;
  const std::vector<double> weights(2, 1.0);
  const WeightedSet set{&x, weights, 2};
  const std::vector<Quantity> states{{"theta", "rad", true}, {"fixed", ""}};
  const Nees nees = normalised_error(set, states, std::vector<double>{-kPi, 0});
  EXPECT_NEAR(nees.value, 0, 1e-12);
  EXPECT_EQ(nees.degrees_of_freedom, 1);
  EXPECT_EQ(normalised_error(set, states, std::vector<double>{kPi, 0.5}).value, kInfinity) << "certain and wrong";
}

TEST(Target, IsThePositionOrTheFirstState) {
  const std::vector<Quantity> plane{{"x", "m"}, {"vx", "m/s"}, {"y", "m"}};
  EXPECT_EQ(target_of("", plane, "test").states, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(target_of("vx", plane, "test").states, (std::vector<std::size_t>{1}));
  EXPECT_EQ(target_of("", {{"level", ""}}, "test").name, "level");
  EXPECT_THROW(target_of("position", {{"level", ""}}, "test"), Refusal);
}

TEST(Contenders, AreNamedOnceAndRefusedByName) {
  std::vector<std::string> notes;
  const auto all = contenders_from(" sisr ;imh --improved; sisr;; sisr", {10, 20}, "test", notes);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[1].name, "imh --improved");
  EXPECT_EQ(all[1].plans[1].particles, 20U);
  EXPECT_EQ(all[3].name, "sisr (3)");
  EXPECT_TRUE(notes.empty());
  contenders_from("sisr --chains 3", {10, 20}, "test", notes);
  EXPECT_EQ(notes, (std::vector<std::string>{
                       "test: --filters: sisr --chains 3: note: --chains is not read: --filter sisr has no chains."}));
  for (const std::string bad : {"", " ; ", "sisr -n 5", "sisr --seed 5", "nope", "imh --chains 15", "sisr sisr"})
    EXPECT_THROW(contenders_from(bad, {10, 20}, "test", notes), Refusal) << bad;
}

}  // namespace
}  // namespace mote::compare

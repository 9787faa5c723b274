#include "mote/software/simd/metropolis.hpp"

#include <gtest/gtest.h>

#include "mote/engine/checkpoint_laws.hpp"
#include "mote/engine/thread_teams.hpp"
#include "mote/filter/adaptive.hpp"
#include "mote/filter/imh.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/engines.hpp"
#include "mote/software/simd/here.hpp"

namespace mote {
namespace {

/// Rows that a model draws itself, one a step.
template <class M>
std::vector<Row<double>> drawn_rows(const M& model, Step steps) {
  std::vector<Row<double>> rows;
  auto prior = Draws{7, 0}.block(Purpose::kTruth);
  auto first = prior.particle(0);
  auto x = model.template initial<double>(first);
  for (Step t = 1; t <= steps; ++t) {
    auto block = Draws{7, static_cast<std::uint32_t>(t)}.block(Purpose::kTruth);
    auto draw = block.particle(0);
    x = model.template next<double>(t, x, draw);
    rows.push_back(model.template observe<double>(t, x, blank_row(model), draw));
  }
  return rows;
}

/// What is compared of a step.
struct Told {
  StepReport report;
  std::vector<Moments> moments;
};

/// Runs a filter over the rows; every fifth step goes without its row.
std::vector<Told> run(Filter& filter, const std::vector<Row<double>>& rows, std::size_t dimensions) {
  std::vector<Told> all;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Step t = static_cast<Step>(k) + 1;
    Told told;
    told.report = t % 5 == 0 ? filter.predict(t) : filter.update(t, {&rows[k], 1});
    for (std::size_t d = 0; d < dimensions; ++d) told.moments.push_back(filter.moments(d, false));
    filter.select(t, told.report);
    all.push_back(told);
  }
  return all;
}

/// Largest difference of two runs' estimates, in standard deviations, of their evidence, acceptance and effective
/// sample size. Standard deviations of few particles may be nothing; `least` is taken then.
double difference(const std::vector<Told>& a, const std::vector<Told>& b, double least) {
  double worst = 0;
  const auto note = [&](double x, double y, double unit) {
    if (std::isnan(x) != std::isnan(y)) worst = kInfinity;
    if (!std::isnan(x) && x != y) worst = std::max(worst, std::abs(x - y) / unit);
  };
  for (std::size_t t = 0; t < a.size(); ++t) {
    EXPECT_EQ(a[t].report.selected, b[t].report.selected) << t;
    EXPECT_EQ(a[t].report.collapsed, b[t].report.collapsed) << t;
    EXPECT_EQ(a[t].report.burn_in, b[t].report.burn_in) << t;
    note(a[t].report.log_evidence, b[t].report.log_evidence, 1);
    note(a[t].report.acceptance, b[t].report.acceptance, 1);
    note(a[t].report.ess, b[t].report.ess, b[t].report.ess);
    for (std::size_t d = 0; d < a[t].moments.size(); ++d) {
      note(a[t].moments[d].mean, b[t].moments[d].mean, std::max(least, b[t].moments[d].sd));
      note(a[t].moments[d].sd, b[t].moments[d].sd, std::max(least, b[t].moments[d].sd));
    }
  }
  return worst;
}

struct Case {
  std::size_t particles;
  ChainOptions options;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::size_t chains : {1, 2, 7, 8, 15, 16, 17, 33, 64}) all.push_back({3000, {.chains = chains}});
  for (const std::size_t particles : {1, 5, 16, 63, 1023, 1024, 1025})
    all.push_back({particles, {.chains = std::min<std::size_t>(particles, 5)}});
  for (const auto parents : {mote::Parents::kIid, mote::Parents::kPermuted, mote::Parents::kSweep})
    for (const auto start : {ChainStart::kFirst, ChainStart::kWeighted})
      all.push_back({700, {.draws = 1500, .burn_in = 21, .chains = 19, .parents = parents, .start = start}});
  return all;
}
std::string text(const Case& c) {
  return "N " + std::to_string(c.particles) + ", P " + std::to_string(c.options.chains) + ", parents " +
         std::to_string(static_cast<int>(c.options.parents)) + ", start " +
         std::to_string(static_cast<int>(c.options.start));
}

Plan plan_of(const Case& c, Precision precision = Precision::kDouble, OnCollapse on_collapse = OnCollapse::kStop) {
  Plan plan;
  plan.filter = FilterKind::kAuxiliary;
  plan.particles = c.particles;
  plan.seed = 3;
  plan.chain = c.options;
  plan.precision = precision;
  plan.on_collapse = on_collapse;
  return plan;
}

/// A filter on the vectors that this file is compiled for.
template <class M>
std::unique_ptr<Filter> vectors(const M& model, const Plan& plan) {
  return simd_filter<M, kIsaHere>(model, plan, "test");
}

/// The difference of both engines' runs.
template <class M>
double from_reference(const M& model, const std::vector<Row<double>>& rows, const Plan& plan, double least) {
  const std::size_t dimensions = model.states().size();
  return difference(run(*vectors(model, plan), rows, dimensions),
                    run(*reference_filter(model, plan, "test"), rows, dimensions), least);
}

/// The same by a proposal, with which plans do not come to vectors.
template <class R>
double from_reference_by_observation(const Ungm<1>& model, const std::vector<Row<double>>& rows, const Case& c) {
  const auto reference = make_auxiliary<R, UngmObservation>(model, c.particles, 3, c.options, OnCollapse::kStop);
  VectorMetropolisFilter<Ungm<1>, R, UngmObservation> filter(model, c.particles, 3, c.options, OnCollapse::kStop, 1);
  return difference(run(filter, rows, 1), run(*reference, rows, 1), 0.1);
}

template <class M>
void expect_reference(const M& model, Precision precision, double least, double tolerance) {
  const auto rows = drawn_rows(model, 12);
  for (const Case& c : cases())
    EXPECT_LT(from_reference(model, rows, plan_of(c, precision), least), tolerance) << text(c);
}
template <class R>
void expect_reference_by_observation(double tolerance) {
  const Ungm<1> model;
  const auto rows = drawn_rows(model, 12);
  for (const Case& c : cases()) EXPECT_LT(from_reference_by_observation<R>(model, rows, c), tolerance) << text(c);
}

TEST(VectorMetropolis, IsTheReferenceStepByStep) {
  expect_reference(Ungm<1>{}, Precision::kDouble, 0.1, 1e-3);
  expect_reference(Ungm<2>{}, Precision::kDouble, 0.1, 1e-3);
  expect_reference(Bearings{}, Precision::kDouble, 1e-4, 1e-3);
  expect_reference_by_observation<double>(1e-3);
}

LinearGaussian six_states() {
  LinearGaussianParameters p;
  p.F = 0.9 * Eigen::MatrixXd::Identity(6, 6);
  p.Q = 0.5 * Eigen::MatrixXd::Identity(6, 6);
  p.H = Eigen::MatrixXd::Identity(2, 6);
  p.R = Eigen::MatrixXd::Identity(2, 2);
  p.mean = Eigen::VectorXd::Zero(6);
  p.covariance = Eigen::MatrixXd::Identity(6, 6);
  p.state_names = {"a", "b", "c", "d", "e", "f"};
  p.observation_names = {"y1", "y2"};
  return LinearGaussian(p);
}

// claim    proposals that are more or fewer than their parents are the reference's, with states that chains carry and
//          with those that are gathered
// referee  the reference engine, whose numbers follow the same weights
TEST(VectorMetropolis, ChangesItsNumberAsTheReferenceDoes) {
  const auto check = [](const auto& model, const ChainOptions& chains) {
    const auto rows = drawn_rows(model, 30);
    const Plan plan = plan_of({3000, chains});
    const AdaptiveOptions options{.most = 3000, .error = 0.07};
    AdaptiveFilter referee(reference_filter(model, plan, "test"), options);
    AdaptiveFilter vector(vectors(model, plan), options);
    const std::size_t dimensions = model.states().size();
    EXPECT_LT(difference(run(vector, rows, dimensions), run(referee, rows, dimensions), 0.1), 1e-3);
    EXPECT_LT(vector.counts().least, 2048U);
    EXPECT_EQ(vector.counts().most, 3000U + chains.chains * *chains.burn_in);
  };
  for (const auto parents : {mote::Parents::kIid, mote::Parents::kPermuted, mote::Parents::kSweep})
    for (const auto start : {ChainStart::kFirst, ChainStart::kWeighted})
      check(Ungm<1>{}, {.burn_in = 21, .chains = 19, .parents = parents, .start = start});
  check(six_states(), {.burn_in = 0, .chains = 8});
}

// In float a chain's decision may fall the other way, and with it one of N states.
TEST(VectorMetropolis, IsTheReferenceStepByStepInFloat) {
  expect_reference(Ungm<1>{}, Precision::kFloat, 0.1, 0.05);
  expect_reference(Bearings{}, Precision::kFloat, 1e-4, 0.05);
  expect_reference_by_observation<float>(0.05);
}

TEST(VectorMetropolis, TwinAnotherSeedIsNotTheReference) {
  const Ungm<1> model;
  const auto rows = drawn_rows(model, 12);
  const Plan plan = plan_of({3000, {.chains = 16}});
  Plan other = plan;
  other.seed = 4;
  EXPECT_GT(difference(run(*vectors(model, other), rows, 1), run(*reference_filter(model, plan, "test"), rows, 1), 0.1),
            0.05);
}

void expect_same_on_any_number_of_threads(Precision precision) {
  const Ungm<1> model;
  const auto rows = drawn_rows(model, 6);
  for (const ChainOptions& options :
       {ChainOptions{.chains = 64},
        ChainOptions{.draws = 60000, .burn_in = 10, .chains = 33, .start = ChainStart::kWeighted}}) {
    std::vector<std::vector<Told>> all;
    for (const std::size_t threads : {1, 2, 3, 8}) {
      Plan plan = plan_of({40001, options}, precision);
      plan.threads = threads;
      all.push_back(run(*vectors(model, plan), rows, 1));
    }
    for (const auto& told : all) EXPECT_EQ(difference(told, all[0], 1), 0);
  }
}
TEST(VectorMetropolis, ResultsDoNotDependOnThreads) {
  expect_same_on_any_number_of_threads(Precision::kFloat);
  expect_same_on_any_number_of_threads(Precision::kDouble);
}

void expect_resumed(const Case& c, Precision precision, OnCollapse on_collapse) {
  const Ungm<1> model;
  Recording recording;
  const auto rows = drawn_rows(model, 8);
  for (Step t = 2; t <= 8; ++t) recording.steps.push_back({t, {rows[static_cast<std::size_t>(t) - 1]}});
  recording.steps[2].rows.clear();
  recording.steps[4].rows = {Row<double>::of({1e300})};
  RunRequest request;
  request.states = model.states();
  const Plan plan = plan_of(c, precision, on_collapse);
  const auto make = [&] { return vectors(model, plan); };
  EXPECT_EQ(laws::broken_promise(make, plan, recording, request), "") << text(c);
}
TEST(VectorMetropolis, IsResumedBitByBit) {
  for (const Case& c : cases())
    for (const OnCollapse on_collapse : {OnCollapse::kKeep, OnCollapse::kReset}) {
      expect_resumed(c, Precision::kDouble, on_collapse);
      expect_resumed(c, Precision::kFloat, on_collapse);
    }
}

// A row that no state explains, and one that is no number: all weights are zero.
void expect_reference_on_collapse(Precision precision) {
  const Ungm<1> model;
  for (const double impossible : {1e200, kNaN})
    for (const auto on_collapse : {OnCollapse::kStop, OnCollapse::kKeep, OnCollapse::kReset})
      for (const auto start : {ChainStart::kFirst, ChainStart::kWeighted}) {
        auto rows = drawn_rows(model, 8);
        rows[2].values[0] = impossible;
        const Case c{1500, {.draws = 2500, .burn_in = 3, .chains = 20, .start = start}};
        const Plan plan = plan_of(c, precision, on_collapse);
        EXPECT_LT(from_reference(model, rows, plan, 0.1), 0.05) << impossible;
        const auto told = run(*vectors(model, plan), rows, 1);
        EXPECT_TRUE(told[2].report.collapsed);
        EXPECT_EQ(told[2].report.log_evidence, -kInfinity);
        for (const Told& step : told) EXPECT_TRUE(std::isfinite(step.moments[0].mean + step.moments[0].sd));
      }
}
TEST(VectorMetropolis, CollapsesAsTheReference) {
  expect_reference_on_collapse(Precision::kFloat);
  expect_reference_on_collapse(Precision::kDouble);
}

TEST(VectorMetropolis, ShowsWeightsThatAgreeWithItsMoments) {
  const Bearings model;
  const auto rows = drawn_rows(model, 4);
  const auto made = vectors(model, plan_of({2500, {.draws = 3001, .chains = 16}}, Precision::kFloat));
  Filter& filter = *made;
  for (Step t = 1; t <= 4; ++t) {
    StepReport report = t == 2 ? filter.predict(t) : filter.update(t, {&rows[static_cast<std::size_t>(t) - 1], 1});
    const WeightedSet set = filter.weighted();
    EXPECT_EQ(set.size(), t == 2 ? 2500U : 3001U);
    for (std::size_t d = 0; d < 4; ++d)
      for (const bool angle : {false, true}) {
        const Moments expected = component_moments(set, d, angle);
        EXPECT_NEAR(filter.moments(d, angle).mean, expected.mean, 1e-6) << d;
        EXPECT_NEAR(filter.moments(d, angle).sd, expected.sd, angle ? 2e-4 : 1e-3 * expected.sd) << d;
      }
    filter.select(t, report);
  }
}

/// Whether every rank of a team tells the same, bit by bit, as a filter that is alone.
template <class Make>
void expect_the_same_on_teams(const Make& make, const std::vector<Row<double>>& rows, std::size_t dimensions,
                              const Plan& plan, const std::vector<std::size_t>& teams) {
  const auto expected = run(*make(plan), rows, dimensions);
  for (const std::size_t ranks : teams) {
    std::vector<std::vector<Told>> told(ranks);
    ThreadTeams(ranks).run([&](Team& team) {
      Plan mine = plan;
      mine.team = &team;
      told[team.rank()] = run(*make(mine), rows, dimensions);
    });
    for (const auto& mine : told) EXPECT_EQ(difference(mine, expected, 1e-300), 0) << ranks << " ranks";
  }
}

template <class M>
void expect_the_same_on_teams(const M& model, const Plan& plan, const std::vector<std::size_t>& teams) {
  expect_the_same_on_teams([&](const Plan& mine) { return vectors(model, mine); }, drawn_rows(model, 11),
                           model.states().size(), plan, teams);
}

/// A model that no particle of most steps can explain.
struct Doomed : LocalLevel {
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& row) const {
    return t % 3 == 0 ? S(-kInfinity) : LocalLevel::log_likelihood<S>(t, x, row);
  }
};

// Uneven shares of chains; blocks that chains of two ranks visit, and burn-in far from what is kept; states that chains
// carry along (one, four) and that they do not (six).
TEST(VectorMetropolis, TeamsChangeNoBit) {
  for (const ChainStart start : {ChainStart::kFirst, ChainStart::kWeighted}) {
    expect_the_same_on_teams(Ungm<1>{}, plan_of({8 * kBlock, {.chains = 16, .start = start}}), {1, 2, 3, 5, 8});
    const ChainOptions many{.burn_in = 70, .chains = 37, .parents = mote::Parents::kPermuted, .start = start};
    expect_the_same_on_teams(Ungm<1>{}, plan_of({9 * kBlock + 77, many}, Precision::kFloat), {2, 3, 7});
    const ChainOptions longer{.draws = 7 * kBlock + 5, .burn_in = 21, .chains = 5, .start = start};
    expect_the_same_on_teams(Bearings{}, plan_of({5 * kBlock, longer}), {2, 5});
    expect_the_same_on_teams(six_states(), plan_of({3 * kBlock, {.chains = 10, .start = start}}), {3});
    for (const OnCollapse policy : {OnCollapse::kKeep, OnCollapse::kReset})
      expect_the_same_on_teams(
          [](const Plan& plan) {
            return std::make_unique<VectorMetropolisFilter<Doomed, double>>(
                Doomed{}, plan.particles, plan.seed, plan.chain, plan.on_collapse, 1, Estimates::kSpreads, plan.team);
          },
          drawn_rows(Doomed{}, 11), 1, plan_of({4 * kBlock, {.chains = 7, .start = start}}, Precision::kDouble, policy),
          {3});
  }
}

/// log p(y_1, ...) of a local level, by its Kalman filter.
double exact_log_evidence(const LocalLevelParameters& p, const std::vector<Row<double>>& rows) {
  double mean = p.level0;
  double variance = p.p0;
  double sum = 0;
  for (const Row<double>& row : rows) {
    variance += p.var_level;
    const double all = variance + p.var_obs;
    const double residual = row[0] - mean;
    sum -= 0.5 * (residual * residual / all + std::log(2 * kPi * all));
    mean += variance / all * residual;
    variance *= p.var_obs / all;
  }
  return sum;
}

// claim    the product of the steps' evidence estimates p(y), up to the chains' finite length
// referee  the Kalman filter, exact for this model
// design   300 filters of 4096 particles in 16 chains, seeds 1..300, 12 rows
// risk     false alarm 1e-6 (|z| < 4.89); the twin (variance of the measurements 5 % too large) must be caught
double evidence_z(const LocalLevel& model) {
  const LocalLevel truth;
  const auto rows = drawn_rows(truth, 12);
  const double exact = exact_log_evidence(truth.p, rows);
  constexpr std::size_t kFilters = 300;
  double sum = 0;
  double squares = 0;
  for (std::size_t seed = 1; seed <= kFilters; ++seed) {
    Plan plan = plan_of({4096, {.burn_in = 20, .chains = 16}}, Precision::kFloat);
    plan.seed = seed;
    const auto made = vectors(model, plan);
    Filter& filter = *made;
    double log_evidence = -exact;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      StepReport report = filter.update(static_cast<Step>(k) + 1, {&rows[k], 1});
      log_evidence += report.log_evidence;
      filter.select(static_cast<Step>(k) + 1, report);
    }
    sum += std::exp(log_evidence);
    squares += std::exp(2 * log_evidence);
  }
  const double mean = sum / kFilters;
  return (mean - 1) / std::sqrt((squares / kFilters - mean * mean) / kFilters);
}
TEST(VectorMetropolis, EstimatesTheEvidence) {
  EXPECT_LT(std::abs(evidence_z({})), 4.89);
  EXPECT_GT(std::abs(evidence_z({{.var_obs = 15099 * 1.05}})), 4.89) << "the twin";
}

}  // namespace
}  // namespace mote

#include "mote/engine/run.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/filter/imh.hpp"
#include "mote/filter/kalman.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/filter/sqmc.hpp"
#include "mote/model/local_level.hpp"

namespace mote {
namespace {

const LocalLevel kModel{{1, 2, 0, 4}};
constexpr std::size_t kParticles = 50;

Row<double> seen(double y) { return Row<double>::of({y}); }

RunRequest request_for(const std::vector<Quantity>& states) {
  RunRequest request;
  request.states = states;
  return request;
}

RunRecord recorded(Filter& filter, const Recording& recording, OnCollapse on_collapse = OnCollapse::kStop) {
  Plan plan;
  plan.particles = kParticles;
  plan.on_collapse = on_collapse;
  return run(filter, plan, recording, request_for(kModel.states()));
}

/// Estimates of a filter stepped by hand.
double mean_of(const Filter& filter) { return component_moments(filter.weighted(), 0, false).mean; }

// Bit for bit: run() adds nothing to the calls that its contract names.
void expect_gaps_and_missing_rows(const std::function<std::unique_ptr<Filter>()>& make) {
  Recording recording;
  recording.steps = {{3, {seen(1)}}, {4, {}}, {7, {seen(0.5), seen(-1)}}};
  const auto ran = make();
  const RunRecord record = recorded(*ran, recording);
  ASSERT_EQ(record.rows.size(), 3U);
  EXPECT_EQ(record.predicted_steps, 7U);
  EXPECT_FALSE(record.interrupted);

  const auto by_hand = make();
  by_hand->predict(1);
  by_hand->predict(2);
  StepReport report = by_hand->update(3, recording.steps[0].rows);
  EXPECT_EQ(record.rows[0].t, 3);
  EXPECT_EQ(record.rows[0].states[0].mean, mean_of(*by_hand)) << "estimated before selection";
  by_hand->select(3, report);
  EXPECT_EQ(record.rows[0].report.log_evidence, report.log_evidence);
  EXPECT_EQ(record.rows[0].report.ess, report.ess);
  EXPECT_TRUE(record.rows[0].report.selected);

  report = by_hand->predict(4);
  EXPECT_EQ(record.rows[1].states[0].mean, mean_of(*by_hand));
  EXPECT_EQ(record.rows[1].report.log_evidence, 0);
  EXPECT_FALSE(record.rows[1].report.selected) << "a step without an observation does not select";

  by_hand->predict(5);
  by_hand->predict(6);
  report = by_hand->update(7, recording.steps[2].rows);
  EXPECT_EQ(record.rows[2].states[0].mean, mean_of(*by_hand));
  EXPECT_EQ(record.rows[2].report.log_evidence, report.log_evidence);
}

TEST(Run, PredictsAcrossGapsAndStepsWithoutObservation) {
  expect_gaps_and_missing_rows([] { return make_sisr(kModel, kParticles, 5); });
  expect_gaps_and_missing_rows([] { return make_imh(kModel, kParticles, 5); });
  expect_gaps_and_missing_rows([] { return make_sisr<float>(kModel, kParticles, 5); });
  expect_gaps_and_missing_rows([] { return make_sqmc(kModel, kParticles, 5); });
}

// Two measurements y1, y2 of variance r are one of mean (y1 + y2) / 2 and variance r / 2, up to a constant of the
// evidence.
TEST(Run, RowsOfAStepMultiply) {
  const LocalLevel precise{{1, 1, 0, 4}};
  Recording twice;
  twice.steps = {{1, {seen(1), seen(2)}}};
  Recording once;
  once.steps = {{1, {seen(1.5)}}};
  const auto a = make_sisr(kModel, kParticles, 3);
  const auto b = make_sisr(precise, kParticles, 3);
  const RunRecord ra = recorded(*a, twice);
  const RunRecord rb = recorded(*b, once);
  EXPECT_NEAR(ra.rows[0].states[0].mean, rb.rows[0].states[0].mean, 1e-12);
  const double constant = 2 * normal_log_density(0.5, 2.0) - normal_log_density(0.0, 1.0);
  EXPECT_NEAR(ra.rows[0].report.log_evidence, rb.rows[0].report.log_evidence + constant, 1e-12);
}

/// A model of a user's own: a walk whose likelihood is zero at step `doom`, except for states above `safe`.
struct Doomed {
  template <class S>
  using State = std::array<S, 1>;
  Step doom = 2;
  double safe = kInfinity;
  std::vector<Quantity> states() const { return {{"x", ""}}; }
  std::vector<Column> columns() const { return {{"y", ""}}; }
  template <class S, class D>
  State<S> initial(D& draw) const {
    return {draw.normal()};
  }
  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    return {before[0] + draw.normal()};
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    using namespace numbers;
    return t == doom ? select(less(S(safe), x[0]), S(0), S(-kInfinity)) : normal_log_density(y[0] - x[0], 1.0);
  }
};

Recording four_steps() {
  Recording recording;
  for (Step t = 1; t <= 4; ++t) recording.steps.push_back({t, {seen(0.1 * t)}});
  return recording;
}

using MakeDoomed = std::function<std::unique_ptr<Filter>(OnCollapse)>;
std::vector<MakeDoomed> doomed_filters(const Doomed& model) {
  GroupOptions groups;
  groups.groups = 4;
  return {
      [=](OnCollapse c) { return make_sisr(model, kParticles, 2, {}, c); },
      [=](OnCollapse c) { return make_sisr<float>(model, kParticles, 2, {}, c); },
      [=](OnCollapse c) { return make_distributed(model, kParticles, 2, groups, {}, c); },
      [=](OnCollapse c) { return make_imh(model, kParticles, 2, {.chains = 2, .start = ChainStart::kWeighted}, c); },
      [=](OnCollapse c) { return make_sqmc(model, kParticles, 2, c); },
      [=](OnCollapse c) { return make_sqmc<float>(model, kParticles, 2, c); },
      [=](OnCollapse c) { return make_imh(model, kParticles, 2, {.burn_in = std::nullopt}, c); },
      [=](OnCollapse c) {
        return make_auxiliary(model, kParticles, 2, {.parent_weights = ParentWeights::kLookahead}, c);
      }};
}

TEST(Run, ACollapseStopsWithItsOwnExitCode) {
  for (const auto& make : doomed_filters({})) {
    const auto filter = make(OnCollapse::kStop);
    try {
      recorded(*filter, four_steps());
      ADD_FAILURE() << "went on";
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kCollapsed);
      EXPECT_NE(std::string(refusal.what()).find("t = 2"), std::string::npos);
      EXPECT_NE(std::string(refusal.what()).find("--on-collapse"), std::string::npos);
    }
  }
}

// A Kalman filter has no particles to weigh: the sentence says what it has.
TEST(Run, ACollapseOfALawIsSaidOfTheLaw) {
  const auto filter = make_ekf(kModel, kParticles);
  Plan plan;
  plan.filter = FilterKind::kEkf;
  Recording recording;
  recording.steps = {{1, {seen(1e300)}}};
  try {
    run(*filter, plan, recording, request_for(kModel.states()));
    ADD_FAILURE() << "went on";
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kCollapsed);
    EXPECT_NE(std::string(refusal.what()).find("density zero"), std::string::npos);
  }
}

TEST(Run, KeepAndResetGoOnAndCount) {
  for (const auto& make : doomed_filters({}))
    for (const OnCollapse policy : {OnCollapse::kKeep, OnCollapse::kReset}) {
      const auto filter = make(policy);
      const RunRecord record = recorded(*filter, four_steps(), policy);
      ASSERT_EQ(record.rows.size(), 4U);
      EXPECT_TRUE(record.rows[1].report.collapsed);
      EXPECT_EQ(record.rows[1].report.log_evidence, -kInfinity);
      EXPECT_GE(record.rows[1].report.ess, static_cast<double>(kParticles)) << "equal weights";
      for (const std::size_t k : {0U, 2U, 3U}) {
        EXPECT_FALSE(record.rows[k].report.collapsed);
        EXPECT_TRUE(std::isfinite(record.rows[k].report.log_evidence));
      }
      for (const auto& row : record.rows) EXPECT_TRUE(std::isfinite(row.states[0].mean) && row.states[0].sd > 0);
      EXPECT_EQ(summarise(record, nullptr).collapses, 1U);
      EXPECT_EQ(summarise(record, nullptr).log_evidence, -kInfinity);
    }
}

// After a reset the particles come from the prior N(0, 1) and are weighed: only those above 0 survive a likelihood that
// wants it.
TEST(Run, AResetWeighsParticlesOfThePrior) {
  Doomed model{2, 0};
  Recording far = four_steps();
  far.steps[0].rows = {seen(-30)};  // drives every survivor far below zero
  int recovered = 0;
  for (const auto& make : doomed_filters(model)) {
    const auto filter = make(OnCollapse::kReset);
    filter->update(1, far.steps[0].rows);
    StepReport report;
    filter->select(1, report);
    report = filter->update(2, far.steps[1].rows);
    if (!report.collapsed) continue;  // a filter with a survivor above zero has nothing to recover from
    ++recovered;
    EXPECT_GT(mean_of(*filter), 0.3);
    EXPECT_LT(mean_of(*filter), 1.5);
    EXPECT_LT(report.ess, static_cast<double>(kParticles));
  }
  EXPECT_GE(recovered, 3);
}

TEST(Run, StopsWhenTold) {
  std::atomic<bool> stop = false;
  const auto filter = make_sisr(kModel, kParticles, 1);
  RunRequest request = request_for(kModel.states());
  request.stop = &stop;
  request.progress = [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 4U);
    stop = done == 2;
  };
  const RunRecord record = run(*filter, Plan{}, four_steps(), request);
  EXPECT_TRUE(record.interrupted);
  EXPECT_EQ(record.rows.size(), 2U);
}

TEST(Run, AStopAfterTheLastStepInterruptsNothing) {
  std::atomic<bool> stop = false;
  const auto filter = make_sisr(kModel, kParticles, 1);
  RunRequest request = request_for(kModel.states());
  request.stop = &stop;
  request.progress = [&](std::size_t done, std::size_t all) { stop = done == all; };
  EXPECT_FALSE(run(*filter, Plan{}, four_steps(), request).interrupted);
}

TEST(Run, StopsInsideALongGap) {
  std::atomic<bool> stop = true;
  const auto filter = make_sisr(kModel, kParticles, 1);
  Recording late;
  late.steps = {{1000000000, {seen(0)}}};
  RunRequest request = request_for(kModel.states());
  request.stop = &stop;
  const RunRecord record = run(*filter, Plan{}, late, request);
  EXPECT_TRUE(record.interrupted);
  EXPECT_TRUE(record.rows.empty());
}

TEST(Run, TakesEstimandsAndDumpsBeforeSelection) {
  const auto filter = make_sisr(kModel, kParticles, 1);
  RunRequest request = request_for(kModel.states());
  request.sources = value_sources(kModel);
  request.estimands = {parse_estimand("P(level>0)", request.sources, ""), parse_estimand("level", request.sources, "")};
  std::vector<double> dumped;
  request.dump = [&](Step, const WeightedSet& set) { dumped.push_back(component_moments(set, 0, false).mean); };
  const RunRecord record = run(*filter, Plan{}, four_steps(), request);
  EXPECT_EQ(record.function_labels, (std::vector<std::string>{"P(level>0)", "level"}));
  ASSERT_EQ(dumped.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(dumped[k], record.rows[k].states[0].mean);
    EXPECT_EQ(record.rows[k].functions[1], record.rows[k].states[0].mean);
    EXPECT_GE(record.rows[k].functions[0], 0);
    EXPECT_LE(record.rows[k].functions[0], 1);
  }
}

}  // namespace
}  // namespace mote

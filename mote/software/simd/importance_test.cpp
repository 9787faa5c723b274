#include "mote/software/simd/importance.hpp"

#include <gtest/gtest.h>

#include "mote/engine/thread_teams.hpp"
#include "mote/filter/adaptive.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/simd/both_engines.hpp"

namespace mote {
namespace {

// claim    the SIMD engine is the reference engine, step by step from the same draws
// referee  the reference engine
// design   12 steps of each model; N = 1501 in double, neither whole blocks nor whole vectors, and 101 in float.
//          One child that rounding gives to the next particle moves all sums a little, so all children after it, and
//          from then on the engines agree in law only: the chance of that grows like N^2, so N is small
// risk     none: fixed seeds. The twin (another seed) must be caught
constexpr double kSame = 0.02;

void expect_the_same_filter(const Plan& plan) {
  EXPECT_LT((distance_of_engines(Ungm<1>{}, plan)), kSame);
  EXPECT_LT((distance_of_engines(Ungm<2>{}, plan)), kSame);
  EXPECT_LT((distance_of_engines(Doa{{}, 3}, plan)), kSame);
  EXPECT_LT((distance_of_engines(Bearings{}, plan)), kSame);
}

TEST(VectorImportanceFilter, IsTheReferenceFilterStepByStep) {
  expect_the_same_filter(float_plan(101));
  expect_the_same_filter(plan_of(1501));
  EXPECT_LT((distance_of_engines(sixteen_states(), plan_of(1501))), kSame);
}

TEST(VectorImportanceFilter, TwinAnotherSeedIsCaught) {
  const Ungm<1> model;
  const Recording recording = recording_of(model);
  EXPECT_GT(distance(rows_of(model, *vectors(model, plan_of(1501, 5)), plan_of(), recording),
                     rows_of(model, *vectors(model, plan_of(1501, 6)), plan_of(), recording)),
            kSame);
}

TEST(VectorImportanceFilter, SelectsAsTheReferenceFilterDoes) {
  for (const Scheme& scheme : schemes())
    for (const double threshold : {1.0, 0.5, 0.0})
      for (const double exponent : {1.0, 0.5}) {
        Plan plan = plan_of(301);
        plan.selection = {&scheme, threshold, exponent};
        EXPECT_LT((distance_of_engines(Ungm<1>{}, plan)), kSame) << scheme.name << " " << threshold << " " << exponent;
      }
}

/// Both engines with numbers of particles that follow the weights; how far these went is noted.
double distance_of_adaptive_engines(const SelectionOptions& selection, std::size_t threads, ParticleCounts& counts) {
  const Ungm<1> model;
  Plan plan = plan_of();
  plan.selection = selection;
  plan.threads = threads;
  const Recording recording = recording_of(model);
  const AdaptiveOptions options{.most = plan.particles, .error = 0.15};
  AdaptiveFilter referee(by_reference(model, plan), options);
  AdaptiveFilter vector(vectors(model, plan), options);
  const auto rows = rows_of(model, vector, plan, recording);
  counts = vector.counts();
  return distance(rows, rows_of(model, referee, plan, recording));
}

// claim    a selection that leaves more or fewer than it found is the reference's, by every scheme, across blocks
// referee  the reference engine, whose numbers follow the same weights
TEST(VectorImportanceFilter, ChangesItsNumberAsTheReferenceFilterDoes) {
  for (const Scheme& scheme : schemes())
    for (const double exponent : {1.0, 0.5}) {
      ParticleCounts counts;
      EXPECT_LT(distance_of_adaptive_engines({&scheme, 1, exponent}, 1, counts), kSame)
          << scheme.name << " " << exponent;
      EXPECT_LT(counts.least, 1024U);
      EXPECT_EQ(counts.most, 1501U);
    }
  ParticleCounts counts;
  EXPECT_LT(distance_of_adaptive_engines({&systematic_scheme(), 0.5, 1}, 2, counts), kSame);
}

TEST(VectorImportanceFilter, ProposesAsTheReferenceFilterDoes) {
  Plan plan = plan_of();
  plan.proposal = "observation";
  EXPECT_LT((distance_of_engines(Ungm<1>{}, plan)), kSame);
  plan.selection.ess_threshold = 0.3;
  EXPECT_LT((distance_of_engines(Ungm<1>{}, plan)), kSame);
  plan.proposal = "guided";
  EXPECT_LT((distance_of_engines(Bearings{}, plan)), kSame);
}

TEST(VectorImportanceFilter, RecoversFromACollapseAsTheReferenceFilterDoes) {
  for (const auto policy : {OnCollapse::kKeep, OnCollapse::kReset})
    for (const double threshold : {1.0, 0.5}) {
      Plan plan = plan_of();
      plan.on_collapse = policy;
      plan.selection.ess_threshold = threshold;
      const Doomed model;
      const Recording recording = recording_of(model);
      const auto filter = vectors(model, plan);
      auto rows = rows_of(model, *filter, plan, recording);
      EXPECT_TRUE(rows[2].report.collapsed);
      auto expected = rows_of(model, *by_reference(model, plan), plan, recording);
      EXPECT_EQ(expected[2].report.log_evidence, rows[2].report.log_evidence);
      expected[2].report.log_evidence = rows[2].report.log_evidence = 0;
      EXPECT_LT(distance(expected, rows), kSame);
    }
}

TEST(VectorImportanceFilter, ParticlesWithoutADensityCountForNothing) {
  EXPECT_LT((distance_of_engines(Doomed{false}, float_plan(101))), kSame);
  EXPECT_LT((distance_of_engines(Doomed{false}, plan_of())), kSame);
}

TEST(VectorImportanceFilter, ThreadsChangeNoBit) {
  const Bearings model;
  const Recording recording = recording_of(model);
  Plan plan = plan_of();
  plan.particles = 100000;
  const auto one = rows_of(model, *vectors(model, plan), plan, recording);
  for (const std::size_t threads : {2U, 3U, 8U}) {
    plan.threads = threads;
    EXPECT_EQ(distance(one, rows_of(model, *vectors(model, plan), plan, recording)), 0.0) << threads;
  }
}

TEST(VectorImportanceFilter, IsResumedBitByBit) {
  for (const SelectionOptions& selection :
       {SelectionOptions{}, SelectionOptions{.ess_threshold = 0.5}, SelectionOptions{.exponent = 0.5},
        SelectionOptions{.scheme = find_scheme("residual"), .ess_threshold = 0.4, .exponent = 0.7},
        SelectionOptions{.scheme = find_scheme("multinomial")}})
    for (const OnCollapse policy : {OnCollapse::kKeep, OnCollapse::kReset}) {
      Plan plan = plan_of(2500);
      plan.selection = selection;
      plan.on_collapse = policy;
      EXPECT_EQ(broken_promise(Ungm<1>{}, plan), "");
      EXPECT_EQ(broken_promise(Doomed{}, plan), "");
      plan.precision = Precision::kFloat;
      EXPECT_EQ(broken_promise(Ungm<1>{}, plan), "");
    }
  EXPECT_EQ(broken_promise(sixteen_states(), plan_of()), "");
  EXPECT_EQ(broken_promise(Bearings{}, plan_of(40000)), "");
}

/// Whether every rank of a team tells the same, bit by bit, as a filter that is alone.
template <class M>
void expect_the_same_on_teams(const M& model, const Plan& plan, const Recording& recording,
                              const std::vector<std::size_t>& teams) {
  const auto expected = rows_of(model, *vectors(model, plan), plan, recording);
  for (const std::size_t ranks : teams) {
    std::vector<std::vector<EstimateRow>> rows(ranks);
    ThreadTeams(ranks).run([&](Team& team) {
      Plan mine = plan;
      mine.team = &team;
      rows[team.rank()] = rows_of(model, *vectors(model, mine), mine, recording);
    });
    for (const auto& told : rows)
      for (std::size_t k = 0; k < expected.size(); ++k)
        EXPECT_TRUE(laws::same(told[k], expected[k])) << ranks << " ranks, row " << k;
  }
}

// Uneven shares, the last block not whole; children that move by a few and, where one block has all the weight, by
// many; so many blocks that ranks are not told all sums.
TEST(VectorImportanceFilter, TeamsChangeNoBit) {
  for (const double threshold : {1.0, 0.5, 0.0})
    for (const std::size_t particles : {8 * kBlock, 20 * kBlock + 77}) {
      Plan plan = plan_of(particles);
      plan.selection.ess_threshold = threshold;
      expect_the_same_on_teams(Ungm<1>{}, plan, recording_of(Ungm<1>{}), {1, 2, 3, 5, 8});
      plan.precision = Precision::kFloat;
      expect_the_same_on_teams(Ungm<1>{}, plan, recording_of(Ungm<1>{}), {2, 5});
    }
  const std::size_t many = (BlockSums::kMostTold + 1) * kBlock;
  expect_the_same_on_teams(Bearings{}, float_plan(many), recording_of(Bearings{}), {2, 3});
  expect_the_same_on_teams(Ungm<1>{}, plan_of(1000), recording_of(Ungm<1>{}), {1});
  Recording sharp = recording_of(Ungm<1>{{.r = 1e-7}});
  expect_the_same_on_teams(Ungm<1>{{.r = 1e-7}}, plan_of(9 * kBlock), sharp, {2, 3, 9});
  expect_the_same_on_teams(Bearings{}, plan_of(9 * kBlock + 1), recording_of(Bearings{}), {3, 10});
  expect_the_same_on_teams(Doa{{}, 3}, plan_of(9 * kBlock + 1), recording_of(Doa{{}, 3}), {3});
  expect_the_same_on_teams(sixteen_states(), plan_of(3 * kBlock), recording_of(sixteen_states()), {3});
  for (const OnCollapse policy : {OnCollapse::kKeep, OnCollapse::kReset}) {
    Plan plan = plan_of(5 * kBlock);
    plan.on_collapse = policy;
    expect_the_same_on_teams(Doomed{}, plan, recording_of(Doomed{}), {2, 5});
  }
}

TEST(VectorImportanceFilter, MeansAloneAreTheSameMeans) {
  const Ungm<1> model;
  const Recording recording = recording_of(model);
  const Plan plan = plan_of();
  VectorImportanceFilter<Ungm<1>, double> means(model, plan.particles, plan.seed, {}, OnCollapse::kStop, 1,
                                                Estimates::kMeans);
  const auto alone = rows_of(model, means, plan, recording);
  const auto both = rows_of(model, *vectors(model, plan), plan, recording);
  for (std::size_t k = 0; k < both.size(); ++k) {
    EXPECT_NEAR(alone[k].states[0].mean, both[k].states[0].mean, 1e-9);
    EXPECT_TRUE(std::isnan(alone[k].states[0].sd));
  }
}

}  // namespace
}  // namespace mote

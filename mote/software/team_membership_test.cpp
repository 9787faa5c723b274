#include "mote/software/team_membership.hpp"

#include <gtest/gtest.h>

#include "mote/engine/checkpoint_laws.hpp"
#include "mote/engine/run.hpp"
#include "mote/engine/thread_teams.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

/// Steps that the model draws itself; 3 has no observation, 5 is left out.
template <class M>
Recording recording_of(const M& model) {
  Recording recording;
  auto prior = Draws{7, 0}.block(Purpose::kTruth);
  auto first = prior.particle(0);
  auto x = model.template initial<double>(first);
  for (Step t = 1; t <= 9; ++t) {
    auto block = Draws{7, static_cast<std::uint32_t>(t)}.block(Purpose::kTruth);
    auto draw = block.particle(0);
    x = model.template next<double>(t, x, draw);
    if (t == 5) continue;
    recording.steps.push_back({t, {}});
    if (t != 3) recording.steps.back().rows.push_back(model.template observe<double>(t, x, blank_row(model), draw));
  }
  return recording;
}

/// What a filter tells of every step; ranks that are asked for all particles add what they say.
template <class M>
std::vector<EstimateRow> rows_of(const M& model, Filter& filter, const Plan& plan, const Recording& recording) {
  RunRequest request;
  request.states = model.states();
  request.sources = value_sources(model);
  request.estimands.push_back(parse_estimand("q0.9(x)", request.sources, "test"));
  return run(filter, plan, recording, request).rows;
}

template <class R, class M>
void expect_the_same_on_teams(const M& model, Plan plan, const std::vector<std::size_t>& teams) {
  plan.filter = FilterKind::kDistributed;
  const Groups groups(plan.particles, plan.groups.groups);
  const auto made = [&](std::shared_ptr<const Membership> members) {
    return make_distributed<R>(model, plan.particles, plan.seed, plan.groups, plan.selection, plan.on_collapse,
                               std::move(members));
  };
  const Recording recording = recording_of(model);
  const auto expected = rows_of(model, *made(nullptr), plan, recording);
  for (const std::size_t ranks : teams) {
    std::vector<std::vector<EstimateRow>> rows(ranks);
    ThreadTeams(ranks).run([&](Team& team) {
      rows[team.rank()] = rows_of(model, *made(std::make_shared<TeamMembership>(groups, team)), plan, recording);
    });
    for (const auto& told : rows) {
      ASSERT_EQ(told.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k)
        EXPECT_TRUE(laws::same(told[k], expected[k])) << ranks << " ranks, row " << k;
    }
  }
}

Plan plan_of(const GroupOptions& groups, std::size_t particles = 1003) {
  Plan plan;
  plan.particles = particles;
  plan.groups = groups;
  plan.on_collapse = OnCollapse::kKeep;
  return plan;
}

// Groups of uneven sizes that begin anywhere in a block of draws; neighbours on the same rank, on another, on all.
TEST(TeamMembership, TeamsChangeNoBit) {
  for (const Topology topology : {Topology::kRing, Topology::kBidirectional, Topology::kTorus, Topology::kHypercube})
    for (const Exchange exchange : {Exchange::kNone, Exchange::kAppend, Exchange::kReplace, Exchange::kSwap})
      expect_the_same_on_teams<double>(
          Ungm<1>{}, plan_of({.groups = 8, .exchange = exchange, .exchange_count = 2, .topology = topology}),
          {1, 2, 3, 8});
}

TEST(TeamMembership, TeamsChangeNoBitOfOtherSelections) {
  GroupOptions rna{.groups = 7, .resampling = GroupResampling::kNonProportional, .exchange_count = 3};
  expect_the_same_on_teams<float>(Bearings{}, plan_of(rna, 5000), {2, 7});
  rna.exchange_every = 2;
  rna.exchange_when = 0.8;
  expect_the_same_on_teams<double>(Ungm<1>{}, plan_of(rna), {3});
  GroupOptions reset{.groups = 5, .exchange = Exchange::kSwap, .carry_group_weights = false};
  Plan plan = plan_of(reset);
  plan.selection.ess_threshold = 0.5;
  expect_the_same_on_teams<double>(Ungm<1>{}, plan, {2, 5});
}

// Observations that no particle of most groups explains, or of any.
TEST(TeamMembership, TeamsChangeNoBitWhereGroupsCollapse) {
  for (const OnCollapse policy : {OnCollapse::kKeep, OnCollapse::kReset})
    for (const double r : {1e-4, 1e-9}) {
      Plan plan = plan_of({.groups = 6, .exchange = Exchange::kAppend}, 60);
      plan.on_collapse = policy;
      expect_the_same_on_teams<double>(Ungm<1>{{.r = r}}, plan, {2, 6});
    }
}

}  // namespace
}  // namespace mote

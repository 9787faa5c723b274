#include "mote/software/team_membership.hpp"

#include <gtest/gtest.h>

#include "mote/engine/checkpoint_laws.hpp"
#include "mote/engine/drawn_recording.hpp"
#include "mote/engine/run.hpp"
#include "mote/engine/thread_teams.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

/// What a filter tells of every step; ranks that are asked for all particles add what they say.
template <class M>
std::vector<EstimateRow> rows_of(const M& model, Filter& filter, const Plan& plan, const Recording& recording) {
  RunRequest request;
  request.states = model.states();
  request.sources = value_sources(model);
  request.estimands.push_back(parse_estimand("q0.9(" + model.states()[0].name + ")", request.sources, "test"));
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
  const Recording recording = drawn_recording(model, 9);
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

/// A level behind a wall, where nothing is possible, and in the third and sixth step anywhere.
struct Walled : LocalLevel {
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& row) const {
    return t % 3 == 0 || x[0] > 800 ? S(-kInfinity) : LocalLevel::log_likelihood<S>(t, x, row);
  }
};

// Most particles of a group are behind the wall, all of some groups, and now and then all of all.
TEST(TeamMembership, TeamsChangeNoBitWhereGroupsCollapse) {
  for (const OnCollapse policy : {OnCollapse::kKeep, OnCollapse::kReset})
    for (const Exchange exchange : {Exchange::kNone, Exchange::kAppend, Exchange::kReplace}) {
      Plan plan = plan_of({.groups = 6, .exchange = exchange}, 60);
      plan.on_collapse = policy;
      expect_the_same_on_teams<double>(Walled{}, plan, {2, 6});
      const auto filter = make_distributed(Walled{}, plan.particles, plan.seed, plan.groups, {}, policy);
      std::size_t collapses = 0;
      for (const EstimateRow& row : rows_of(Walled{}, *filter, plan, drawn_recording(Walled{}, 9)))
        collapses += row.report.collapsed ? 1 : 0;
      EXPECT_GE(collapses, 3U);
      EXPECT_LT(collapses, 8U);
    }
}

}  // namespace
}  // namespace mote

#include "mote/engine/plan.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/filter/particles.hpp"

namespace mote {
namespace {

/// The refusal of a plan made from the default by `change`, or "".
template <class Change>
std::string refusal(Change&& change) {
  Plan plan;
  change(plan);
  try {
    check(plan, "mote run");
  } catch (const Refusal& r) {
    EXPECT_EQ(r.code(), ExitCode::kWrongUse);
    return r.what();
  }
  return "";
}

/// A plan of a filter, then a change.
template <class Change>
std::string refusal_of(FilterKind filter, Change&& change) {
  return refusal([&](Plan& plan) {
    plan.filter = filter;
    change(plan);
  });
}

bool names(const std::string& sentence, const std::string& option) {
  return sentence.starts_with("mote run: " + option + ": expected") && sentence.find("Pass --") != std::string::npos;
}

TEST(Plan, DefaultsAreAccepted) {
  for (const auto filter : {FilterKind::kSisr, FilterKind::kImh, FilterKind::kAuxiliary, FilterKind::kDistributed,
                            FilterKind::kSqmc, FilterKind::kEkf, FilterKind::kUkf})
    EXPECT_EQ(refusal_of(filter, [](Plan&) {}), "");
}

TEST(Plan, RefusalsNameTheOption) {
  EXPECT_TRUE(names(refusal([](Plan& p) { p.particles = 0; }), "--particles"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.particles = kMostParticles + 1; }), "--particles"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.selection.ess_threshold = -0.1; }), "--ess-threshold"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.selection.ess_threshold = 1.1; }), "--ess-threshold"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.selection.ess_threshold = kNaN; }), "--ess-threshold"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.selection.exponent = 0; }), "--selection-exponent"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.selection.exponent = 1.5; }), "--selection-exponent"));
  EXPECT_TRUE(names(refusal([](Plan& p) { p.selection.exponent = kNaN; }), "--selection-exponent"));
}

TEST(Plan, ChainsAreCheckedForFiltersThatHaveThem) {
  for (const auto filter : {FilterKind::kImh, FilterKind::kAuxiliary}) {
    EXPECT_TRUE(names(refusal_of(filter, [](Plan& p) { p.chain.draws = 999; }), "--draws"))
        << "fewer than the particles";
    EXPECT_TRUE(names(refusal_of(filter, [](Plan& p) { p.chain.chains = 0; }), "--chains"));
    EXPECT_TRUE(names(refusal_of(filter, [](Plan& p) { p.chain.chains = 1001; }), "--chains"));
    EXPECT_TRUE(names(refusal_of(filter, [](Plan& p) { p.chain.burn_in = kMostParticles + 1; }), "--burn-in"));
    EXPECT_EQ(refusal_of(filter, [](Plan& p) { p.chain = {.draws = 1000, .burn_in = std::nullopt, .chains = 1000}; }),
              "");
  }
  EXPECT_EQ(refusal([](Plan& p) { p.chain.chains = 0; }), "") << "SISR has no chains";
}

TEST(Plan, GroupsAreCheckedForTheDistributedFilter) {
  const auto of = [](std::size_t groups, Exchange exchange, std::size_t count) {
    return refusal_of(FilterKind::kDistributed, [&](Plan& p) {
      p.particles = 100;
      p.groups.groups = groups;
      p.groups.exchange = exchange;
      p.groups.exchange_count = count;
    });
  };
  EXPECT_TRUE(names(of(0, Exchange::kNone, 1), "--groups"));
  EXPECT_TRUE(names(of(101, Exchange::kNone, 1), "--groups"));
  EXPECT_EQ(of(100, Exchange::kNone, 0), "");
  EXPECT_TRUE(names(of(8, Exchange::kSwap, 0), "--exchange-count"));
  EXPECT_EQ(of(8, Exchange::kSwap, 12), "") << "the smallest group has 12";
  EXPECT_TRUE(names(of(8, Exchange::kSwap, 13), "--exchange-count"));
  EXPECT_EQ(of(8, Exchange::kReplace, 6), "");
  EXPECT_TRUE(names(of(8, Exchange::kReplace, 7), "--exchange-count"));
}

TEST(Plan, NeighboursMustFitTheGroups) {
  const auto of = [](std::size_t count, const GroupOptions& groups) {
    return refusal_of(FilterKind::kDistributed, [&](Plan& p) {
      p.particles = 16 * 20;
      p.groups = groups;
      p.groups.groups = count;
    });
  };
  const GroupOptions swap{.exchange = Exchange::kSwap, .exchange_count = 5, .topology = Topology::kTorus};
  EXPECT_EQ(of(16, swap), "") << "five for each of four neighbours are all 20";
  GroupOptions more = swap;
  more.exchange_count = 6;
  EXPECT_TRUE(names(of(16, more), "--exchange-count"));
  EXPECT_TRUE(of(16, more).find("from 1 to 5 (groups of 20 particles, 4 neighbours)") != std::string::npos);
  more.resampling = GroupResampling::kNonProportional;
  more.exchange = Exchange::kNone;
  EXPECT_TRUE(names(of(16, more), "--exchange-count")) << "RNA exchanges, too";
  more.resampling = GroupResampling::kProportional;
  EXPECT_EQ(of(16, more), "") << "RPA has no neighbours";
  GroupOptions cube = swap;
  cube.topology = Topology::kHypercube;
  EXPECT_EQ(of(16, cube), "");
  EXPECT_TRUE(names(of(12, cube), "--topology hypercube"));
  EXPECT_NE(of(12, cube).find("got 12. Pass --groups 8, or --topology torus."), std::string::npos) << of(12, cube);
}

TEST(Plan, FiltersHaveTheirCommandLineNames) {
  EXPECT_EQ(name_of(FilterKind::kSisr), "sisr");
  EXPECT_EQ(name_of(FilterKind::kImh), "imh");
  EXPECT_EQ(name_of(FilterKind::kAuxiliary), "auxiliary");
  EXPECT_EQ(name_of(FilterKind::kDistributed), "distributed");
  EXPECT_EQ(name_of(FilterKind::kSqmc), "sqmc");
  EXPECT_EQ(name_of(FilterKind::kEkf), "ekf");
  EXPECT_EQ(name_of(FilterKind::kUkf), "ukf");
}

TEST(Plan, BytesCoverTheArraysThatAFilterHolds) {
  Plan plan;
  plan.particles = 1000000;
  EXPECT_GE(bytes_needed(plan, 4), 1e6 * (4 * 8 + 2 * 8));
  plan.precision = Precision::kFloat;
  EXPECT_GE(bytes_needed(plan, 4), 1e6 * (4 * 4 + 2 * 8));
  plan.precision = Precision::kDouble;
  plan.filter = FilterKind::kSqmc;
  EXPECT_GE(bytes_needed(plan, 4), 1e6 * (2 * 4 * 8 + 3 * 8 + 16));
  for (const auto filter : {FilterKind::kEkf, FilterKind::kUkf}) {
    plan.filter = filter;
    EXPECT_GE(bytes_needed(plan, 4), 1e6 * (3 * 4 * 8 + 8)) << "points, their standard ones, and a product";
  }
  plan.filter = FilterKind::kImh;
  plan.chain.chains = 8;
  plan.chain.burn_in = 1000;
  EXPECT_GE(bytes_needed(plan, 4), 1e6 * (4 * 8 + 4) + 1008000.0 * (4 * 8 + 16));
}

TEST(Plan, SimdHasSisrSqmcAndChainsThatProposeFromThePrior) {
  Plan plan;
  EXPECT_TRUE(simd_has(plan));
  plan.filter = FilterKind::kSqmc;
  EXPECT_TRUE(simd_has(plan));
  EXPECT_FALSE(team_has(plan)) << "its order is of all particles";
  plan.filter = FilterKind::kDistributed;
  EXPECT_FALSE(simd_has(plan));
  EXPECT_EQ(engine_of(plan), Engine::kReference);
  plan.filter = FilterKind::kImh;
  EXPECT_TRUE(simd_has(plan));
  EXPECT_EQ(engine_of(plan), Engine::kSimd);
  plan.proposal = "observation";
  EXPECT_FALSE(simd_has(plan)) << "mixture weights sum over all parents";
  plan.filter = FilterKind::kAuxiliary;
  EXPECT_FALSE(simd_has(plan));
  plan.proposal = "prior";
  EXPECT_TRUE(simd_has(plan));
  plan.chain.parent_weights = ParentWeights::kLookahead;
  EXPECT_FALSE(simd_has(plan));
  plan.chain = {.burn_in = std::nullopt};
  EXPECT_FALSE(simd_has(plan));
}

}  // namespace
}  // namespace mote

#include "mote/filter/groups.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mote {
namespace {

/// n particles of value i; their weights rise by group: group k of `count` has (1 + k)^2 times those of a first one.
Cloud<double> sloping(std::size_t n, std::size_t count) {
  const Groups groups(n, count);
  Cloud<double> cloud(1, std::make_shared<Membership>(groups));
  for (std::size_t i = 0; i < n; ++i) {
    cloud.x.component(0)[i] = static_cast<double>(i);
    cloud.weights[i] = std::pow(1.0 + static_cast<double>(groups.of(i)), 2) * (1.0 + static_cast<double>(5 * i % 7));
    cloud.log_weights[i] = std::log(cloud.weights[i]);
  }
  const double all = log_sum_exp(cloud.log_weights).log_sum;
  for (double& l : cloud.log_weights) l -= all;
  return cloud;
}

/// Largest |z| over particles of the mean number of children against N W, seeds 1..R; exact agreement counts as 0.
template <class Choose>
double worst_z_of_children(const Cloud<double>& cloud, int runs, Choose&& choose) {
  const std::size_t n = cloud.size();
  std::vector<double> sum(n);
  std::vector<double> squares(n);
  std::vector<Index> ancestors(n);
  for (int r = 1; r <= runs; ++r) {
    choose(Draws{static_cast<std::uint64_t>(r), 3}, ancestors);
    std::vector<double> children(n);
    for (const Index a : ancestors) children[a] += 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double error = children[i] - static_cast<double>(n) * std::exp(cloud.log_weights[i]);
      sum[i] += error / runs;
      squares[i] += error * error / runs;
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double deviation = std::sqrt(std::max(0.0, squares[i] - sum[i] * sum[i]) / runs);
    if (std::abs(sum[i]) > 1e-9) worst = std::max(worst, std::abs(sum[i]) / std::max(deviation, 1e-15));
  }
  return worst;
}

// claim    proportional allocation gives every particle N W children in the mean, as global resampling does
// referee  N W
// design   50 particles in 6 groups of 8 or 9, group weights from 1 to 36; 20 000 seeds; every scheme but metropolis
// risk     1e-6 over the 350 means (|z| < 6); the twin (local selection: N_k children in each group) must be caught
TEST(ProportionalAllocation, HasTheMeansOfGlobalResampling) {
  const Cloud<double> cloud = sloping(50, 6);
  const Groups groups(50, 6);
  for (const Scheme& scheme : schemes()) {
    if (scheme.name == "metropolis") continue;  // states a bias
    EXPECT_LT(worst_z_of_children(cloud, 20000,
                                  [&](const Draws& draws, std::span<Index> ancestors) {
                                    allocate(cloud.weights, groups, scheme, draws, ancestors);
                                  }),
              6)
        << scheme.name;
  }
  EXPECT_GT(worst_z_of_children(cloud, 2000,
                                [&](const Draws& draws, std::span<Index> ancestors) {
                                  for (std::size_t k = 0; k < 6; ++k) {
                                    const auto own = ancestors.subspan(groups.first(k), groups.size(k));
                                    systematic(std::span(cloud.weights).subspan(groups.first(k), groups.size(k)),
                                               stream_of(draws, k), own);
                                    for (Index& a : own) a += static_cast<Index>(groups.first(k));
                                  }
                                }),
            6)
      << "the twin";
}

TEST(ProportionalAllocation, MovesNoMoreThanTheSurplus) {
  const Cloud<double> cloud = sloping(50, 6);
  const Groups groups(50, 6);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    std::vector<Index> ancestors(50);
    allocate(cloud.weights, groups, systematic_scheme(), Draws{seed, 1}, ancestors);
    std::vector<std::size_t> children(6);
    for (const Index a : ancestors) ++children[groups.of(a)];
    double surplus = 0;
    for (std::size_t k = 0; k < 6; ++k)
      surplus += static_cast<double>(children[k] - std::min(children[k], groups.size(k)));
    EXPECT_EQ(moved(ancestors, groups, 1).bytes, surplus) << seed;
  }
}

TEST(ProportionalAllocation, OfOneGroupIsThatOfTheScheme) {
  Cloud<double> cloud = sloping(20, 1);
  Cloud<double> other = cloud;
  JointSelector<double>({}, {.groups = 1, .resampling = GroupResampling::kProportional}).select(cloud, 0, {5, 1});
  WholeSelector<double>({}).select(other, 0, Draws{5, 1});
  EXPECT_TRUE(std::equal(cloud.x.component(0).begin(), cloud.x.component(0).end(), other.x.component(0).begin()));
}

// claim    a chain over the particles, its start drawn by weight, gives particle i nearly N w_i children
// referee  N w
// design   40 particles, ESS 30 of 40; 4000 seeds: the largest error of a mean, and that of a chain which ignores
// weight risk     none: fixed seeds. Measured 0.05; the twin (equal weights) is off by 1.4
TEST(VisitAll, DrawsInProportionToWeight) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < 40; ++i) weights.push_back(1.0 + static_cast<double>(5 * i % 7));
  const double all = ordered_sum(40, [&](std::size_t i) { return weights[i]; });
  const auto worst_error = [&](const std::vector<double>& by) {
    std::vector<double> children(40);
    std::vector<Index> ancestors(40);
    for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
      visit_all(by, Draws{seed, 2}, ancestors);
      for (const Index a : ancestors) children[a] += 1.0 / 4000;
    }
    double worst = 0;
    for (std::size_t i = 0; i < 40; ++i) worst = std::max(worst, std::abs(children[i] - 40 * weights[i] / all));
    return worst;
  };
  EXPECT_LT(worst_error(weights), 0.12);
  EXPECT_GT(worst_error(std::vector<double>(40, 1.0)), 0.5) << "the twin";
}

TEST(VisitAll, NeverChoosesAWeightOfZero) {
  std::vector<double> weights(20);
  weights[7] = 1;
  std::vector<Index> ancestors(12);
  visit_all(weights, Draws{3, 1}, ancestors);
  EXPECT_EQ(ancestors, std::vector<Index>(12, 7));
}

TEST(Traffic, CountsChildrenBornElsewhere) {
  const Groups groups(9, 3);
  const std::vector<Index> ancestors{0, 0, 3, 4, 4, 0, 8, 4, 5};
  const Traffic traffic = moved(ancestors, groups, 10);
  EXPECT_EQ(traffic.bytes, 40) << "3 to group 0, 0 to group 1, 4 and 5 to group 2";
  EXPECT_EQ(traffic.messages, 3);
}

TEST(Traffic, OfJointSelectionHasTheSumsAtEveryStep) {
  Cloud<double> cloud = sloping(60, 6);
  const GroupOptions rpa{.groups = 6, .resampling = GroupResampling::kProportional};
  const Selected waits = JointSelector<double>({.ess_threshold = 0.5}, rpa).select(cloud, 31, Draws{1, 1});
  EXPECT_FALSE(waits.any);
  EXPECT_EQ(waits.traffic.messages, 18) << "three rounds of six";
  EXPECT_EQ(waits.traffic.bytes, 6 * 5 * 16) << "sums of weights and of their squares";
  const Selected done = JointSelector<double>({}, rpa).select(cloud, 31, Draws{1, 1});
  EXPECT_TRUE(done.any);
  EXPECT_GT(done.traffic.bytes, 6 * 5 * 8);
  EXPECT_GT(done.traffic.messages, 18);
}

GroupOptions exchanging(Exchange exchange) { return {.groups = 6, .exchange = exchange, .exchange_count = 2}; }

TEST(GroupSelector, ExchangesAtTheMultiplesOnly) {
  for (const Exchange exchange : {Exchange::kSwap, Exchange::kAppend, Exchange::kReplace}) {
    GroupOptions groups = exchanging(exchange);
    groups.exchange_every = 3;
    for (std::uint32_t t = 1; t <= 7; ++t) {
      Cloud<double> cloud = sloping(60, 6);
      Cloud<double> local = cloud;
      const Selected done = GroupSelector<double>({}, groups).select(cloud, 0, Draws{1, t});
      GroupSelector<double>({}, exchanging(Exchange::kNone)).select(local, 0, Draws{1, t});
      const bool same =
          std::equal(cloud.x.component(0).begin(), cloud.x.component(0).end(), local.x.component(0).begin());
      EXPECT_EQ(same, t % 3 != 0) << t;
      EXPECT_EQ(done.traffic.messages, t % 3 == 0 ? 6 : 0) << t;
    }
  }
}

TEST(GroupSelector, ExchangesWhenGroupWeightsDiverge) {
  // weights of the groups are about 1 4 9 16 25 36: (91)^2 / 2275 = 3.64 effective groups of 6
  const Cloud<double> cloud = sloping(60, 6);
  const double effective = effective_groups(cloud.log_weights, *cloud.members);
  EXPECT_NEAR(effective, 3.64, 0.2);
  EXPECT_NEAR(effective_groups(Cloud<double>(1, 60).log_weights, *cloud.members), 6, 1e-12);
  GroupOptions groups = exchanging(Exchange::kSwap);
  for (const auto& [ratio, exchanges] : {std::pair{effective / 6 * 0.999, false}, {effective / 6 * 1.001, true}}) {
    groups.exchange_when = ratio;
    Cloud<double> one = cloud;
    const Selected done = GroupSelector<double>({}, groups).select(one, 0, Draws{1, 1});
    EXPECT_EQ(done.traffic.messages, 18 + (exchanges ? 6 : 0));
    EXPECT_EQ(done.traffic.bytes, 6 * 5 * 8 + (exchanges ? 6 * 2 * 16 : 0));
  }
}

TEST(GroupSelector, OneGroupSendsNothing) {
  for (const GroupResampling resampling : {GroupResampling::kLocal, GroupResampling::kGlobal,
                                           GroupResampling::kProportional, GroupResampling::kNonProportional}) {
    Cloud<double> cloud = sloping(60, 6);
    const GroupOptions one{.groups = 1, .resampling = resampling, .exchange = Exchange::kSwap};
    const Selected done = make_group_selector<double>({}, one)->select(cloud, 0, Draws{1, 1});
    EXPECT_TRUE(done.any);
    EXPECT_EQ(done.traffic.messages, 0);
    EXPECT_EQ(done.traffic.bytes, 0);
  }
}

// RNA is local selection, then a trade: the same children, some in their neighbours' places.
TEST(GroupSelector, TradesAfterTheSelection) {
  Cloud<double> cloud = sloping(60, 6);
  Cloud<double> local = cloud;
  const GroupOptions rna{.groups = 6, .resampling = GroupResampling::kNonProportional, .exchange_count = 2};
  GroupSelector<double>({}, rna).select(cloud, 0, Draws{1, 1});
  GroupSelector<double>({}, {.groups = 6}).select(local, 0, Draws{1, 1});
  trade_evenly(local.x, local.log_weights, *local.members, rna, 1);
  EXPECT_TRUE(std::equal(cloud.x.component(0).begin(), cloud.x.component(0).end(), local.x.component(0).begin()));
  EXPECT_EQ(cloud.log_weights, local.log_weights);
}

}  // namespace
}  // namespace mote

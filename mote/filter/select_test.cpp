#include "mote/filter/select.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/filter/groups.hpp"

namespace mote {
namespace {

/// A cloud of n particles of value i, in groups, with weights (1 + i mod 5)^2 spread around.
Cloud<double> uneven(std::size_t n, std::size_t groups = 1) {
  Cloud<double> cloud(1, std::make_shared<Membership>(Groups(n, groups)));
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    cloud.x.component(0)[i] = static_cast<double>(i);
    cloud.weights[i] = std::pow(1.0 + static_cast<double>(3 * i % 5), 2);
    total += cloud.weights[i];
  }
  for (std::size_t i = 0; i < n; ++i) cloud.log_weights[i] = std::log(cloud.weights[i] / total);
  return cloud;
}

/// sum exp(log_weights) f(x) for f = 1 and f = sin x.
struct Integrals {
  double one = 0, sine = 0;
};
Integrals integrals(const Cloud<double>& cloud) {
  Integrals sums;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double w = std::exp(cloud.log_weights[i]);
    sums.one += w;
    sums.sine += w * std::sin(cloud.x.component(0)[i]);
  }
  return sums;
}

/// Largest |z| of the mean after selection, over the seeds 1..R, of both integrals against those before; exact
/// agreement counts as 0.
template <class Select>
double worst_z(std::size_t n, int runs, Select&& select, std::size_t groups = 1) {
  const Integrals exact = integrals(uneven(n));
  std::array<double, 2> sum{};
  std::array<double, 2> squares{};
  for (int r = 1; r <= runs; ++r) {
    Cloud<double> cloud = uneven(n, groups);
    select(cloud, Draws{static_cast<std::uint64_t>(r), 4});
    const Integrals got = integrals(cloud);
    const std::array<double, 2> error{got.one - exact.one, got.sine - exact.sine};
    for (std::size_t f = 0; f < 2; ++f) {
      sum[f] += error[f] / runs;
      squares[f] += error[f] * error[f] / runs;
    }
  }
  double worst = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    const double deviation = std::sqrt(std::max(0.0, squares[f] - sum[f] * sum[f]) / runs);
    if (std::abs(sum[f]) > 1e-12) worst = std::max(worst, std::abs(sum[f]) / std::max(deviation, 1e-15));
  }
  return worst;
}

// claim    selection keeps E[sum w f], whatever the scheme and the exponent of the selection weights
// referee  the sums before selection, f = 1 and f = sin x
// design   4000 selections of 40 particles, seeds 1..4000
// risk     1e-6 over the 32 cases (|z| < 5.6); the twin (survivors of exponent 0.5 that carry equal weights) must be
//          caught
TEST(Select, KeepsExpectationsForEveryExponent) {
  for (const Scheme& scheme : schemes()) {
    if (scheme.name == "metropolis") continue;  // states a bias
    for (const double exponent : {1.0, 0.5, 0.2, 0.9}) {
      SelectionOptions options;
      options.scheme = &scheme;
      options.exponent = exponent;
      EXPECT_LT(
          worst_z(40, 4000, [&](auto& cloud, const Draws& draws) { resample(cloud, 0, 40, 0.0, options, draws); }), 5.6)
          << scheme.name << ", exponent " << exponent;
    }
  }
  SelectionOptions half;
  half.exponent = 0.5;
  EXPECT_GT(worst_z(40, 4000,
                    [&](auto& cloud, const Draws& draws) {
                      resample(cloud, 0, 40, 0.0, half, draws);
                      cloud.spread();
                    }),
            5.6)
      << "the twin";
}

TEST(Select, ResamplesAPartAndLeavesTheRest) {
  Cloud<double> cloud = uneven(20);
  const Cloud<double> before = cloud;
  resample(cloud, 5, 10, std::log(0.3), {}, Draws{1, 1});
  double mass = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    const bool inside = i >= 5 && i < 15;
    if (inside) {
      mass += std::exp(cloud.log_weights[i]);
      EXPECT_GE(cloud.x.component(0)[i], 5);
      EXPECT_LT(cloud.x.component(0)[i], 15);
    } else {
      EXPECT_EQ(cloud.x.component(0)[i], before.x.component(0)[i]);
      EXPECT_EQ(cloud.log_weights[i], before.log_weights[i]);
    }
  }
  EXPECT_NEAR(mass, 0.3, 1e-12);
}

TEST(Select, WholeSelectorWaitsForTheThreshold) {
  SelectionOptions options;
  options.ess_threshold = 0.5;
  WholeSelector<double> selector(options);
  Cloud<double> cloud = uneven(20);
  EXPECT_FALSE(selector.select(cloud, 10.1, Draws{1, 1}).any);
  EXPECT_EQ(cloud.log_weights, uneven(20).log_weights);
  EXPECT_TRUE(selector.select(cloud, 10.0, Draws{1, 1}).any);
  EXPECT_NEAR(integrals(cloud).one, 1, 1e-12);
}

GroupOptions groups_of(Exchange exchange, bool carry = true) {
  GroupOptions groups;
  groups.groups = 3;
  groups.exchange = exchange;
  groups.exchange_count = 2;
  groups.carry_group_weights = carry;
  return groups;
}

double worst_z_of_groups(const GroupOptions& groups, double exponent, double threshold) {
  SelectionOptions options;
  options.exponent = exponent;
  options.ess_threshold = threshold;
  return worst_z(
      40, 4000,
      [&](auto& cloud, const Draws& draws) { make_group_selector<double>(options, groups)->select(cloud, 0, draws); },
      groups.groups);
}

// claim    groups that carry their weights keep E[sum w f], with swap, append or no exchange, on every topology, and so
//          do RNA and RPA
// referee  the sums before selection
// design   4000 selections of 40 particles in groups of 14 13 13 (two of 20 for the hypercube), seeds 1..4000
// risk     1e-6 over the 60 integrals (|z| < 5.7); the twins (group weights reset, and replace) must be caught
TEST(Select, GroupsKeepExpectations) {
  for (const Exchange exchange : {Exchange::kNone, Exchange::kSwap, Exchange::kAppend})
    for (const double exponent : {1.0, 0.5})
      for (const double threshold : {1.0, 0.7, 0.0})
        EXPECT_LT(worst_z_of_groups(groups_of(exchange), exponent, threshold), 5.7)
            << int(exchange) << ' ' << exponent << ' ' << threshold;
  for (const Exchange exchange : {Exchange::kSwap, Exchange::kAppend})
    for (const Topology topology : {Topology::kBidirectional, Topology::kTorus, Topology::kHypercube}) {
      GroupOptions groups = groups_of(exchange);
      groups.topology = topology;
      if (topology == Topology::kHypercube) groups.groups = 2;
      EXPECT_LT(worst_z_of_groups(groups, 1, 1), 5.7) << int(exchange) << ' ' << int(topology);
    }
  for (const GroupResampling resampling : {GroupResampling::kProportional, GroupResampling::kNonProportional})
    for (const double exponent : {1.0, 0.5}) {
      GroupOptions groups = groups_of(Exchange::kNone);
      groups.resampling = resampling;
      EXPECT_LT(worst_z_of_groups(groups, exponent, 1), 5.7) << int(resampling) << ' ' << exponent;
    }
  EXPECT_GT(worst_z_of_groups(groups_of(Exchange::kNone, false), 1, 1), 5.7) << "PPF's reset is biased";
  EXPECT_GT(worst_z_of_groups(groups_of(Exchange::kReplace), 1, 1), 5.7) << "replace loses weight";
}

TEST(Select, AGroupWithoutWeightWaits) {
  Cloud<double> cloud = uneven(12, 3);
  for (std::size_t i = 4; i < 8; ++i) cloud.log_weights[i] = -kInfinity;
  GroupOptions groups = groups_of(Exchange::kNone);
  GroupSelector<double> selector({}, groups);
  EXPECT_TRUE(selector.select(cloud, 0, Draws{1, 1}).any);
  for (std::size_t i = 4; i < 8; ++i) EXPECT_EQ(cloud.x.component(0)[i], static_cast<double>(i));
  // fresh weights after a reset: each group its share, the empty one too
  groups.carry_group_weights = false;
  cloud = uneven(12, 3);
  for (std::size_t i = 4; i < 8; ++i) cloud.log_weights[i] = -kInfinity;
  GroupSelector<double>({}, groups).select(cloud, 0, Draws{1, 1});
  for (const double l : cloud.log_weights) EXPECT_NEAR(l, -std::log(12.0), 1e-12);
}

TEST(Select, GroupsDrawFromStreamsOfTheirOwn) {
  // equal groups under one scheme would choose alike if they shared their draws
  SelectionOptions options;
  options.scheme = find_scheme("multinomial");
  Cloud<double> cloud(1, std::make_shared<Membership>(Groups(60, 3)));
  for (std::size_t i = 0; i < 60; ++i) cloud.x.component(0)[i] = static_cast<double>(i % 20);
  GroupSelector<double>(options, groups_of(Exchange::kNone)).select(cloud, 0, Draws{1, 1});
  const auto x = cloud.x.component(0);
  EXPECT_FALSE(std::equal(x.begin(), x.begin() + 20, x.begin() + 20));
}

}  // namespace
}  // namespace mote

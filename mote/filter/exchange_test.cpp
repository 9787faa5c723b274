#include "mote/filter/exchange.hpp"

#include <map>

#include <gtest/gtest.h>

#include "mote/base/log_weights.hpp"

namespace mote {
namespace {

/// 11 particles in 3 groups (4, 4, 3); particle i has value i and weight 1 + (7 i mod 11).
struct Scene {
  Particles<double> x{1, 11};
  std::vector<double> log_weights;
  Groups groups{11, 3};
  Scene() : log_weights(11) {
    for (std::size_t i = 0; i < 11; ++i) {
      x.component(0)[i] = static_cast<double>(i);
      log_weights[i] = std::log(1.0 + static_cast<double>(7 * i % 11));
    }
  }
  Inbox<double> send_by(Exchange exchange, std::size_t count) {
    return send(x, log_weights, Membership(groups), {.groups = 3, .exchange = exchange, .exchange_count = count}, 0);
  }
  double total() const { return std::exp(log_sum_exp(log_weights).log_sum); }
  /// Total weight by value.
  std::map<double, double> mass() const {
    std::map<double, double> all;
    for (std::size_t i = 0; i < 11; ++i) all[x.component(0)[i]] += std::exp(log_weights[i]);
    return all;
  }
};

TEST(Exchange, FindsTheExtremesAndBreaksTiesByIndex) {
  const std::vector<double> logs{9, 1, 3, 3, 2, -kInfinity};
  EXPECT_EQ(extreme(logs, 1, 5, 3, true), (std::vector<Index>{2, 3, 4}));
  EXPECT_EQ(extreme(logs, 1, 5, 2, false), (std::vector<Index>{5, 1}));
}

TEST(Exchange, SpreadsPlacesEvenly) {
  EXPECT_EQ(evenly_spread(10, 8, 2), (std::vector<Index>{12, 16}));
  EXPECT_EQ(evenly_spread(0, 5, 1), (std::vector<Index>{2}));
  EXPECT_EQ(evenly_spread(3, 4, 4), (std::vector<Index>{3, 4, 5, 6}));
  EXPECT_TRUE(evenly_spread(3, 4, 0).empty());
}

TEST(Exchange, SwapMovesParticlesWithTheirWeights) {
  Scene scene;
  const Scene before;
  scene.send_by(Exchange::kSwap, 2);
  EXPECT_EQ(scene.mass(), before.mass()) << "the same particles with the same weights";
  // weights 1 8 4 11 | 7 3 10 6 | 2 9 5: heaviest two 3 1 | 6 4 | 9 10, each into the places of the next group's
  // heaviest
  const auto x = scene.x.component(0);
  EXPECT_EQ(std::vector<double>(x.begin(), x.end()), (std::vector<double>{0, 10, 2, 9, 1, 5, 3, 7, 8, 6, 4}));
}

TEST(Exchange, AppendSharesTheWeightBetweenSenderAndCopy) {
  Scene scene;
  const Scene before;
  const auto inbox = scene.send_by(Exchange::kAppend, 1);
  ASSERT_EQ(inbox.count, 1U);
  EXPECT_EQ(inbox.x.component(0)[0], 9) << "group 0 receives the heaviest of group 2";
  EXPECT_EQ(inbox.x.component(0)[1], 3);
  EXPECT_EQ(inbox.x.component(0)[2], 6);
  auto mass = scene.mass();
  for (std::size_t k = 0; k < 3; ++k) mass[inbox.x.component(0)[k]] += std::exp(inbox.log_weights[k]);
  for (const auto& [value, weight] : before.mass()) EXPECT_NEAR(mass[value], weight, 1e-12) << value;
  EXPECT_NEAR(std::exp(scene.log_weights[3]), 11 / 2.0, 1e-12);
}

TEST(Exchange, ReplaceLosesTheWeightOfTheLightest) {
  Scene scene;
  const Scene before;
  scene.send_by(Exchange::kReplace, 1);
  auto mass = scene.mass();
  // lightest: 0 (weight 1), 5 (3), 8 (2) are gone, the heaviest keep their weight in two halves
  EXPECT_EQ(mass.count(0) + mass.count(5) + mass.count(8), 0U);
  EXPECT_EQ(scene.x.component(0)[0], 9);
  EXPECT_NEAR(std::exp(scene.log_weights[0]), std::exp(scene.log_weights[9]), 1e-12);
  EXPECT_NEAR(mass[9], 9, 1e-12);
  EXPECT_NEAR(scene.total(), before.total() - 6, 1e-12);
}

/// One particle of the obvious exchange below.
struct Marble {
  double value, weight;
  bool operator<(const Marble& other) const { return std::tie(value, weight) < std::tie(other.value, other.weight); }
};
using Bags = std::vector<std::vector<Marble>>;

/// The neighbours of group k by coordinates, written out anew.
std::vector<std::size_t> beside(Topology topology, int groups, int k, int turn) {
  std::vector<int> all;
  if (topology == Topology::kRing || topology == Topology::kBidirectional) all.push_back(k == groups - 1 ? 0 : k + 1);
  if (topology == Topology::kBidirectional) all.push_back(k == 0 ? groups - 1 : k - 1);
  if (topology == Topology::kTorus) {
    const std::map<int, std::pair<int, int>> sides{{4, {2, 2}}, {6, {2, 3}}, {8, {2, 4}}, {9, {3, 3}}, {16, {4, 4}}};
    const auto [rows, columns] = sides.at(groups);
    const int r = k / columns;
    const int c = k % columns;
    all = {r * columns + (c + 1) % columns, r * columns + (c + columns - 1) % columns, (r + 1) % rows * columns + c,
           (r + rows - 1) % rows * columns + c};
  }
  if (topology == Topology::kHypercube) {
    const std::map<int, int> dimensions{{4, 2}, {8, 3}, {16, 4}};
    const int bit = 1 << (turn % dimensions.at(groups));
    all.push_back((k / bit) % 2 == 0 ? k + bit : k - bit);
  }
  std::vector<std::size_t> once;
  for (const int other : all)
    if (other != k && std::find(once.begin(), once.end(), static_cast<std::size_t>(other)) == once.end())
      once.push_back(static_cast<std::size_t>(other));
  return once;
}

/// The exchange, particle by particle: each group takes its heaviest out in turn and hands them round; what it received
/// is what the others put into its bag.
Bags exchanged_obviously(Bags bags, Exchange exchange, Topology topology, std::size_t count, int turn) {
  const auto heavier = [](const Marble& a, const Marble& b) { return a.weight > b.weight; };
  const auto groups = static_cast<int>(bags.size());
  Bags received(bags.size());
  for (int k = 0; k < groups; ++k) {
    auto& own = bags[static_cast<std::size_t>(k)];
    std::stable_sort(own.begin(), own.end(), heavier);
    const auto to = beside(topology, groups, k, turn);
    for (std::size_t rank = 0; rank < count * to.size(); ++rank) {
      if (exchange != Exchange::kSwap) own[rank].weight /= 2;
      received[to[rank % to.size()]].push_back(own[rank]);
    }
    if (exchange == Exchange::kSwap) own.erase(own.begin(), own.begin() + static_cast<long>(count * to.size()));
  }
  for (std::size_t k = 0; k < bags.size(); ++k) {
    if (exchange == Exchange::kReplace) {
      // halved weights are not lighter for it: the lightest are those of before
      bags[k].resize(bags[k].size() - received[k].size());
    }
    bags[k].insert(bags[k].end(), received[k].begin(), received[k].end());
  }
  return bags;
}

/// The contents of every group, own and received, in the order of their values.
Bags bags_of(const Particles<double>& x, std::span<const double> log_weights, const Groups& groups,
             const Inbox<double>& inbox) {
  Bags bags(groups.count());
  for (std::size_t k = 0; k < groups.count(); ++k) {
    for (std::size_t i = groups.first(k); i < groups.first(k + 1); ++i)
      bags[k].push_back({x.component(0)[i], std::exp(log_weights[i])});
    for (std::size_t j = k * inbox.count; j < (k + 1) * inbox.count; ++j)
      bags[k].push_back({inbox.x.component(0)[j], std::exp(inbox.log_weights[j])});
  }
  return bags;
}

// claim    every exchange on every topology hands on the particles that it should, with the weights that it should
// referee  bags of particles handed round one by one, by coordinates
// design   K = 4, 6, 8, 9, 16 groups of 12 or 13 particles, M = 1, 2, 3, four turns
TEST(Exchange, IsTheObviousOneOnEveryTopology) {
  for (const std::size_t count : {4U, 6U, 8U, 9U, 16U})
    for (const Topology topology :
         {Topology::kRing, Topology::kBidirectional, Topology::kTorus, Topology::kHypercube}) {
      if (topology == Topology::kHypercube && (count & (count - 1)) != 0) continue;
      for (const Exchange exchange : {Exchange::kSwap, Exchange::kAppend, Exchange::kReplace})
        for (const std::size_t each : {1U, 2U, 3U})
          for (const int turn : {0, 1, 2, 5}) {
            const std::size_t n = 12 * count + 3;
            if (exchange == Exchange::kReplace && 2 * each * degree(topology, count) > 12) continue;
            const Groups groups(n, count);
            Particles<double> x(1, n);
            std::vector<double> log_weights;
            for (std::size_t i = 0; i < n; ++i) {
              x.component(0)[i] = static_cast<double>(i);
              log_weights.push_back(std::log(1.0 + static_cast<double>(89 * i % 211)));  // all different
            }
            Bags expected = exchanged_obviously(bags_of(x, log_weights, groups, {}), exchange, topology, each, turn);
            const auto inbox =
                send(x, log_weights, Membership(groups),
                     {.groups = count, .exchange = exchange, .exchange_count = each, .topology = topology},
                     static_cast<std::size_t>(turn));
            Bags got = bags_of(x, log_weights, groups, inbox);
            for (std::size_t k = 0; k < count; ++k) {
              std::sort(expected[k].begin(), expected[k].end());
              std::sort(got[k].begin(), got[k].end());
              ASSERT_EQ(got[k].size(), expected[k].size());
              for (std::size_t j = 0; j < got[k].size(); ++j) {
                ASSERT_EQ(got[k][j].value, expected[k][j].value) << "group " << k << " of " << count;
                ASSERT_NEAR(got[k][j].weight, expected[k][j].weight, 1e-9);
              }
            }
          }
    }
}

TEST(Exchange, TradesEvenlySpreadParticlesAndLosesNone) {
  Scene scene;
  const Scene before;
  trade_evenly(scene.x, scene.log_weights, Membership(scene.groups), {.groups = 3, .exchange_count = 2}, 0);
  EXPECT_EQ(scene.mass(), before.mass());
  const auto x = scene.x.component(0);  // places 1 3 | 5 7 | 8 10
  EXPECT_EQ(std::vector<double>(x.begin(), x.end()), (std::vector<double>{0, 8, 2, 10, 4, 1, 6, 3, 5, 9, 7}));
}

TEST(Exchange, CountsWhatItSends) {
  const auto sent = [](Topology topology) {
    return exchanged<float>({.groups = 16, .exchange_count = 3, .topology = topology}, 4);
  };
  EXPECT_EQ(sent(Topology::kRing).messages, 16);
  EXPECT_EQ(sent(Topology::kRing).bytes, 16 * 3 * (4 * 4 + 8));
  EXPECT_EQ(sent(Topology::kBidirectional).messages, 32);
  EXPECT_EQ(sent(Topology::kTorus).messages, 64);
  EXPECT_EQ(sent(Topology::kTorus).bytes, 64 * 3 * (4 * 4 + 8));
  EXPECT_EQ(sent(Topology::kHypercube).messages, 16);
  EXPECT_EQ(all_gathered(16, 8).messages, 64);
  EXPECT_EQ(all_gathered(16, 8).bytes, 16 * 15 * 8);
  EXPECT_EQ(all_gathered(5, 8).messages, 15) << "three rounds of five";
  EXPECT_EQ(all_gathered(1, 8).messages, 0);
}

}  // namespace
}  // namespace mote

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
  Ring ring{11, 3};
  Scene() : log_weights(11) {
    for (std::size_t i = 0; i < 11; ++i) {
      x.component(0)[i] = static_cast<double>(i);
      log_weights[i] = std::log(1.0 + static_cast<double>(7 * i % 11));
    }
  }
  Inbox<double> send_by(Exchange exchange, std::size_t count) {
    GroupOptions options;
    options.groups = 3;
    options.exchange = exchange;
    options.exchange_count = count;
    return send(x, log_weights, ring, options);
  }
  double total() const { return std::exp(log_sum_exp(log_weights).log_sum); }
  /// Total weight by value.
  std::map<double, double> mass() const {
    std::map<double, double> all;
    for (std::size_t i = 0; i < 11; ++i) all[x.component(0)[i]] += std::exp(log_weights[i]);
    return all;
  }
};

TEST(Ring, CutsIntoGroupsThatDifferByAtMostOne) {
  const Ring ring(11, 3);
  EXPECT_EQ(ring.first(0), 0U);
  EXPECT_EQ(ring.first(1), 4U);
  EXPECT_EQ(ring.first(2), 8U);
  EXPECT_EQ(ring.first(3), 11U);
  EXPECT_EQ(ring.size(2), 3U);
  EXPECT_EQ(ring.before(0), 2U);
  EXPECT_EQ(ring.before(2), 1U);
}

TEST(Exchange, FindsTheExtremesAndBreaksTiesByIndex) {
  const std::vector<double> logs{9, 1, 3, 3, 2, -kInfinity};
  EXPECT_EQ(extreme(logs, 1, 5, 3, true), (std::vector<Index>{2, 3, 4}));
  EXPECT_EQ(extreme(logs, 1, 5, 2, false), (std::vector<Index>{5, 1}));
}

TEST(Exchange, NoneAndOneGroupChangeNothing) {
  Scene scene;
  const Scene before;
  EXPECT_EQ(scene.send_by(Exchange::kNone, 2).count, 0U);
  scene.ring = Ring(11, 1);
  EXPECT_EQ(scene.send_by(Exchange::kSwap, 2).count, 0U);
  EXPECT_EQ(scene.mass(), before.mass());
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

}  // namespace
}  // namespace mote

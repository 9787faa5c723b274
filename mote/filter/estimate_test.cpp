#include "mote/filter/estimate.hpp"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace mote {
namespace {

struct Cloud {
  std::vector<double> values, weights;
  double total() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
};

/// Values of a fixed generator with weights that are whole numbers 0..4: a multiset that brute force can unroll.
Cloud whole(std::size_t n, double centre, double spread) {
  std::mt19937 generator(7);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    cloud.values.push_back(centre + spread * (static_cast<double>(generator() % 10007) / 10007 - 0.5));
    cloud.weights.push_back(static_cast<double>(generator() % 5));
  }
  return cloud;
}
/// Every value as often as its weight says, sorted.
std::vector<double> unrolled(const Cloud& cloud) {
  std::vector<double> all;
  for (std::size_t i = 0; i < cloud.values.size(); ++i)
    all.insert(all.end(), static_cast<std::size_t>(cloud.weights[i]), cloud.values[i]);
  std::sort(all.begin(), all.end());
  return all;
}
Moments of(const Cloud& cloud, bool angle) {
  return moments<double>(cloud.values, cloud.weights, cloud.total(), angle);
}

TEST(Moments, AreThoseOfTheUnrolledMultiset) {
  const Cloud cloud = whole(3000, 5, 8);
  const auto all = unrolled(cloud);
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  double squares = 0;
  for (const double v : all) squares += (v - mean) * (v - mean);
  EXPECT_NEAR(of(cloud, false).mean, mean, 1e-10);
  EXPECT_NEAR(of(cloud, false).sd, std::sqrt(squares / static_cast<double>(all.size())), 1e-10);
}

TEST(Moments, KeepASmallSpreadFarFromZero) {
  const Cloud cloud{{1e9 - 1, 1e9 + 1}, {1, 1}};
  EXPECT_DOUBLE_EQ(of(cloud, false).mean, 1e9);
  EXPECT_DOUBLE_EQ(of(cloud, false).sd, 1);
}

TEST(Moments, ValuesOfWeightZeroDoNotCount) {
  const Cloud cloud{{1, kNaN, kInfinity, 3}, {1, 0, 0, 1}};
  EXPECT_DOUBLE_EQ(of(cloud, false).mean, 2);
  EXPECT_DOUBLE_EQ(of(cloud, true).mean, 2);
}

TEST(Moments, FloatValuesAreSummedInDouble) {
  const std::vector<float> values(1U << 20U, 0.1F);
  const std::vector<double> weights(1U << 20U, 1.0);
  EXPECT_NEAR(moments<float>(values, weights, 1U << 20U, false).mean, static_cast<double>(0.1F), 1e-13);
}

TEST(CircularMoments, CrossPi) {
  const Cloud cloud{{3.1, -3.1}, {1, 1}};
  EXPECT_NEAR(std::abs(of(cloud, true).mean), kPi, 1e-12);
  EXPECT_NEAR(of(cloud, true).sd, kPi - 3.1, 1e-3) << "small spreads: the plain deviation";
  EXPECT_NEAR(of(cloud, false).mean, 0, 1e-12) << "the twin: a plain mean points the other way";
}

TEST(CircularMoments, TurnWithTheData) {
  Cloud cloud = whole(500, 0, 1.5);
  const Moments at_zero = of(cloud, true);
  for (double turn = -10; turn < 10; turn += 0.7) {
    Cloud turned = cloud;
    for (double& v : turned.values) v = numbers::wrap(v + turn);
    EXPECT_NEAR(numbers::wrap(of(turned, true).mean - at_zero.mean - turn), 0, 1e-12);
    EXPECT_NEAR(of(turned, true).sd, at_zero.sd, 1e-12);
  }
}

TEST(CircularMoments, APointHasNoSpread) {
  const Cloud cloud{{2, 2, 2}, {0.1, 0.7, 0.3}};
  EXPECT_EQ(of(cloud, true).sd, 0) << "rounding must not make the root of a negative number";
}

TEST(Quantile, IsTheSmallestValueThatReachesItsLevel) {
  const Cloud cloud = whole(400, 0, 20);
  const auto all = unrolled(cloud);
  const auto n = static_cast<double>(all.size());
  for (const double level : {0.001, 0.05, 0.25, 0.5, 0.777, 0.9, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(level * n - 1e-9));
    EXPECT_EQ(quantile(cloud.values, cloud.weights, level, false), all[rank - 1]) << level;
  }
  EXPECT_EQ(quantile(cloud.values, cloud.weights, 0, false), all.front());
}

TEST(Quantile, OfAnAngleIsTakenAboutTheCircularMean) {
  // 2.9, 3.0, 3.1, -3.1, -3.0: the middle one is 3.1
  const Cloud cloud{{-3.0, 3.1, 2.9, -3.1, 3.0}, {1, 1, 1, 1, 1}};
  EXPECT_NEAR(quantile(cloud.values, cloud.weights, 0.5, true), 3.1, 1e-12);
  EXPECT_NEAR(quantile(cloud.values, cloud.weights, 0, true), 2.9, 1e-12);
  EXPECT_NEAR(quantile(cloud.values, cloud.weights, 1, true), -3.0, 1e-12);
  EXPECT_NEAR(quantile(cloud.values, cloud.weights, 0.5, false), 2.9, 1e-12) << "the twin: on the line";
}

// Sums of tenths in two orders differ by roundings, so the last value may miss level 1 by one: it must still be
// wrapped.
TEST(Quantile, OfAnAngleStaysInItsRangeAtLevelOne) {
  for (int n = 2; n < 60; ++n) {
    Cloud cloud;
    for (int i = 0; i < n; ++i) {
      cloud.values.push_back(numbers::wrap(kPi + 0.01 * ((7 * i) % n - n / 2)));
      cloud.weights.push_back(0.1 + 0.1 * ((3 * i) % 7));
    }
    const double last = quantile(cloud.values, cloud.weights, 1, true);
    EXPECT_LT(last, kPi) << n;
    EXPECT_GE(last, -kPi) << n;
  }
}

TEST(Probability, IsTheShareBeyondTheThreshold) {
  const Cloud cloud{{1, 2, 3, 4}, {1, 2, 3, 4}};
  EXPECT_DOUBLE_EQ(probability(cloud.values, cloud.weights, 2, true), 0.7);
  EXPECT_DOUBLE_EQ(probability(cloud.values, cloud.weights, 2, false), 0.1);
  EXPECT_DOUBLE_EQ(probability(cloud.values, cloud.weights, 9, true), 0);
  EXPECT_DOUBLE_EQ(probability(cloud.values, cloud.weights, 9, false), 1);
}

TEST(ComponentMoments, ReadOneComponentOfEitherType) {
  Particles<float> x(2, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    x.component(0)[i] = static_cast<float>(i);
    x.component(1)[i] = 10;
  }
  const std::vector<double> weights{1, 0, 1};
  const WeightedSet set{&x, weights, 2};
  EXPECT_DOUBLE_EQ(component_moments(set, 0, false).mean, 1);
  EXPECT_DOUBLE_EQ(component_moments(set, 0, false).sd, 1);
  EXPECT_DOUBLE_EQ(component_moments(set, 1, false).mean, 10);
}

}  // namespace
}  // namespace mote

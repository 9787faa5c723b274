#include "mote/base/exact_sum.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace mote {
namespace {

std::vector<double> terms(std::size_t n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-80, 10);
  std::vector<double> all(n);
  for (double& term : all) term = std::ldexp(mantissa(random), exponent(random));
  return all;
}

double summed(const std::vector<double>& all, std::size_t groups) {
  std::vector<ExactSum> parts(groups);
  for (std::size_t i = 0; i < all.size(); ++i) parts[i % groups].add(all[i]);
  ExactSum sum;
  for (const ExactSum& part : parts) sum += part;
  return sum.value();
}

TEST(ExactSum, DependsOnNoOrderAndNoGroups) {
  std::vector<double> all = terms(10000);
  const double expected = summed(all, 1);
  double plain = 0;
  for (const double term : all) plain += term;
  EXPECT_NEAR(expected, plain, 1e-9);
  std::mt19937 random(2);
  bool plain_differs = false;
  for (const std::size_t groups : {1U, 2U, 3U, 64U}) {
    std::shuffle(all.begin(), all.end(), random);
    EXPECT_EQ(summed(all, groups), expected);
    double other = 0;
    for (const double term : all) other += term;
    plain_differs = plain_differs || other != plain;
  }
  EXPECT_TRUE(plain_differs) << "the twin: sums of doubles depend on the order";
}

TEST(ExactSum, KeepsWhatHasItsBits) {
  ExactSum sum;
  for (const double term : {std::ldexp(1.0, 18), std::ldexp(1.0, -96), -std::ldexp(1.0, 18)}) sum.add(term);
  EXPECT_EQ(sum.value(), std::ldexp(1.0, -96));
  sum.add(std::ldexp(1.0, -97));
  EXPECT_EQ(sum.value(), std::ldexp(1.0, -96)) << "less is cut off";
  ExactSum large;
  for (int i = 0; i < 1024; ++i) large.add(std::ldexp(1.0, 18));
  EXPECT_EQ(large.value(), std::ldexp(1.0, 28));
}

}  // namespace
}  // namespace mote

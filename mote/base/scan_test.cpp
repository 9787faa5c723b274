#include "mote/base/scan.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mote/base/draws.hpp"

namespace mote {
namespace {

std::vector<double> uneven(std::size_t n) {
  std::vector<double> w(n);
  Draws{3, 0}.for_each(Purpose::kTest, 0, n, [&](std::size_t i, auto& draw) { w[i] = std::exp(3 * draw.normal()); });
  return w;
}

TEST(WeightScan, FindsByInversion) {
  const std::vector<double> w{0, 1, 0, 2, 3, 0};
  const WeightScan scan(w);
  EXPECT_DOUBLE_EQ(scan.total(), 6);
  EXPECT_EQ(scan.find(0), 1U);
  EXPECT_EQ(scan.find(0.999), 1U);
  EXPECT_EQ(scan.find(1), 3U);
  EXPECT_EQ(scan.find(5.999), 4U);
  EXPECT_EQ(scan.find(6), 4U) << "a target past the total gives the last positive weight";
}

TEST(WeightScan, WalkAndFindAgree) {
  auto w = uneven(5000);
  std::fill(w.begin() + 2048, w.begin() + 3072, 0.0);
  const WeightScan scan(w);
  WeightScan::Walk walk(scan);
  for (int k = 0; k <= 3000; ++k) {
    const double target = scan.total() * k / 3000;
    EXPECT_EQ(walk.find(target), scan.find(target));
  }
}

// referee  long double prefix sums (64 bits of fraction) with Kahan's compensation
// the twin, a running float sum, must misplace whole percents
TEST(WeightScan, IsExactEnoughAtTwoToThe24) {
  constexpr std::size_t kCount = 1U << 24U;
  const auto w = uneven(kCount);
  const WeightScan scan(w);
  long double exact = 0;
  long double carry = 0;
  float naive = 0;
  double worst_naive = 0;
  WeightScan::Walk walk(scan);
  const double mean = scan.total() / kCount;
  double misplaced = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const long double step = static_cast<long double>(w[i]) - carry;
    const long double next = exact + step;
    carry = (next - exact) - step;
    exact = next;
    naive += static_cast<float>(w[i]);
    worst_naive = std::max(worst_naive, std::abs(static_cast<double>(naive - exact)) / mean);
    if (i % 4099 == 0 && i + 1 < kCount) {
      // a target a hundred-thousandth of a mean weight before (after) the boundary must be found at (past) i
      misplaced += walk.find(static_cast<double>(exact) - 1e-5 * mean) > i;
      misplaced += scan.find(static_cast<double>(exact) + 1e-5 * mean) <= i;
    }
  }
  EXPECT_EQ(misplaced, 0);
  EXPECT_NEAR(scan.total() / static_cast<double>(exact), 1, 1e-15);
  EXPECT_GT(worst_naive, 1000) << "the naive float sum should be far off here";
}

}  // namespace
}  // namespace mote

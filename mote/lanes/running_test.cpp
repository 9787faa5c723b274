#include "mote/lanes/running.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace mote::lanes {
inline namespace HWY_NAMESPACE {
namespace {

template <class R>
constexpr std::size_t kLanes = Registers<R>::kPerRegister;

/// A register's lanes, to look at.
template <class R>
std::vector<Whole<R>> lanes_of(WholeRegister<R> v) {
  std::vector<Whole<R>> lane(kLanes<R>);
  hn::StoreU(v, WholeTag<R>{}, lane.data());
  return lane;
}
template <class R>
std::vector<R> numbers_of(NumberRegister<R> v) {
  std::vector<R> lane(kLanes<R>);
  hn::StoreU(v, typename Registers<R>::Tag{}, lane.data());
  return lane;
}

template <class R>
class Running : public ::testing::Test {};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Running, Numbers);

TYPED_TEST(Running, SumsAreThoseOfALoop) {
  using R = TypeParam;
  std::mt19937_64 random(1);
  for (int round = 0; round < 1000; ++round) {
    std::vector<Whole<R>> given(kLanes<R>);
    for (auto& x : given) x = static_cast<Whole<R>>(random() >> (std::is_same_v<R, float> ? 38 : 16));
    const auto v = hn::LoadU(WholeTag<R>{}, given.data());
    auto expected = given;
    for (std::size_t k = 1; k < expected.size(); ++k) expected[k] += expected[k - 1];
    EXPECT_EQ(lanes_of<R>(running_sum(v)), expected);
    EXPECT_EQ(lanes_of<R>(last_lane(v)), std::vector<Whole<R>>(kLanes<R>, given.back()));
    auto shifted = given;
    shifted.insert(shifted.begin(), given.back());
    shifted.pop_back();
    EXPECT_EQ(lanes_of<R>(preceding(v, v)), shifted);
  }
}

TYPED_TEST(Running, RoundsAsTheStandardLibraryDoes) {
  using R = TypeParam;
  const typename Registers<R>::Tag tag;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-3, std::is_same_v<R, float> ? 30.9 : 51.9);
  for (int round = 0; round < 10000; ++round) {
    const R x = round < 8 ? R(0.5) * static_cast<R>(round) : static_cast<R>(std::exp2(exponent(random)));
    EXPECT_EQ(lanes_of<R>(nearest(hn::Set(tag, x))).front(), static_cast<Whole<R>>(std::nearbyint(x))) << x;
    EXPECT_EQ(lanes_of<R>(rounded_up(hn::Set(tag, x))).front(), static_cast<Whole<R>>(std::ceil(x))) << x;
    const auto whole = static_cast<Whole<R>>(x);
    EXPECT_EQ(numbers_of<R>(as_number(hn::Set(WholeTag<R>{}, whole))).front(), static_cast<R>(whole));
  }
}

// What one thread does with subnormal numbers while the guard lives, and no longer.
TEST(Subnormals, AreZeroWhileTheGuardLives) {
  volatile float least = std::numeric_limits<float>::min();
  volatile float half = 0.5F;
  {
    const SubnormalsAreZero fast;
    EXPECT_EQ(least * half, 0.0F);
  }
  EXPECT_GT(least * half, 0.0F) << "the twin";
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes

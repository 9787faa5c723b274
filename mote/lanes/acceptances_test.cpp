#include "mote/lanes/acceptances.hpp"

#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace mote::lanes {
inline namespace HWY_NAMESPACE {
namespace {

template <class R>
class AcceptancesOf : public ::testing::Test {
 protected:
  static constexpr std::size_t kLanes = kWidth<R>;
  using Square = std::array<std::array<bool, kLanes>, kLanes>;  // by step and lane

  static Acceptances<R> turned(const Square& square) {
    typename Acceptances<R>::BySteps by_steps;
    for (std::size_t step = 0; step < kLanes; ++step) {
      std::array<R, kLanes> accepts{};
      std::copy(square[step].begin(), square[step].end(), accepts.begin());
      by_steps.note(step, Vector<R>(0) < Vector<R>::load(accepts.data()));
    }
    Acceptances<R> all;
    all.turn(by_steps);
    return all;
  }
  /// What a lane holds, step by step.
  static void expect_held(const Square& square, const Acceptances<R>& accepted, std::size_t lane) {
    std::array<R, kLanes> offered{};
    std::iota(offered.begin(), offered.end(), R(100));
    R at = -7;
    std::uint32_t steps = 0;
    std::array<R, kLanes> expected{};
    for (std::size_t step = 0; step < kLanes; ++step) {
      if (square[step][lane]) at = offered[step];
      steps |= std::uint32_t{square[step][lane]} << step;
      expected[step] = at;
    }
    std::array<R, kLanes> held{};
    accepted.held(lane, Vector<R>::load(offered.data()), R(-7)).store(held.data());
    EXPECT_EQ(held, expected) << lane;
    EXPECT_EQ(accepted.steps(lane), steps) << lane;
  }
};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AcceptancesOf, Numbers);

TYPED_TEST(AcceptancesOf, LanesHoldWhatTheyAcceptedLast) {
  constexpr std::size_t kWide = kWidth<TypeParam>;
  std::mt19937_64 random(5);
  for (const unsigned one_in : {1U, 2U, 5U, 40U}) {
    for (int round = 0; round < 200; ++round) {
      typename TestFixture::Square square{};
      std::size_t all = 0;
      std::size_t some = 0;
      for (auto& step : square) {
        for (std::size_t lane = 0; lane < kWide; ++lane) {
          step[lane] = random() % one_in == 0;
          all += std::size_t{step[lane]};
          some += std::size_t{step[lane] && lane < 3};
        }
      }
      const auto accepted = this->turned(square);
      for (std::size_t lane = 0; lane < kWide; ++lane) this->expect_held(square, accepted, lane);
      EXPECT_EQ(accepted.count(kWide), all);
      EXPECT_EQ(accepted.count(3), some);
    }
  }
}

TYPED_TEST(AcceptancesOf, NobodyWhoAcceptsNothingMoves) {
  const auto accepted = this->turned({});
  for (std::size_t lane = 0; lane < kWidth<TypeParam>; ++lane) this->expect_held({}, accepted, lane);
  EXPECT_EQ(accepted.count(kWidth<TypeParam>), 0U);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes

#include "mote/lanes/compaction.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace mote::lanes {
inline namespace HWY_NAMESPACE {
namespace {

template <class R>
class Compaction : public ::testing::Test {
 protected:
  static constexpr std::size_t kLanes = Registers<R>::kPerRegister;

  static std::vector<Whole<R>> lanes_of(WholeRegister<R> v) {
    std::vector<Whole<R>> lane(kLanes);
    hn::StoreU(v, WholeTag<R>{}, lane.data());
    return lane;
  }
  static std::vector<R> numbers_of(NumberRegister<R> v) {
    std::vector<R> lane(kLanes);
    hn::StoreU(v, typename Registers<R>::Tag{}, lane.data());
    return lane;
  }
};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Compaction, Numbers);

TYPED_TEST(Compaction, KeepsWhatAComparisonHoldsForInOrder) {
  using R = TypeParam;
  std::vector<Whole<R>> lane(Registers<R>::kPerRegister);
  std::vector<R> number(Registers<R>::kPerRegister);
  for (std::size_t bits = 0; bits < std::size_t{1} << Registers<R>::kPerRegister; ++bits) {
    std::vector<R> expected;
    for (std::size_t k = 0; k < lane.size(); ++k) {
      lane[k] = static_cast<Whole<R>>(bits >> k & 1U);
      number[k] = static_cast<R>(k + 1);
      if (lane[k] > 0) expected.push_back(number[k]);
    }
    const Keeper<R> kept(hn::Gt(hn::LoadU(WholeTag<R>{}, lane.data()), hn::Zero(WholeTag<R>{})));
    ASSERT_EQ(kept.count(), expected.size());
    auto numbers = this->numbers_of(kept(hn::LoadU(typename Registers<R>::Tag{}, number.data())));
    numbers.resize(expected.size());
    ASSERT_EQ(numbers, expected) << bits;
    for (std::size_t k = 0; k < lane.size(); ++k) lane[k] *= static_cast<Whole<R>>(k + 1);
    auto wholes = this->lanes_of(kept(hn::LoadU(WholeTag<R>{}, lane.data())));
    for (std::size_t k = 0; k < expected.size(); ++k) ASSERT_EQ(wholes[k], static_cast<Whole<R>>(expected[k])) << bits;
  }
}

TYPED_TEST(Compaction, RepeatsUpToTheNextMark) {
  using R = TypeParam;
  constexpr std::size_t kPer = Registers<R>::kPerRegister;
  std::vector<R> values(64 + kPer);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<R>(k + 10);
  std::mt19937_64 random(4);
  for (std::size_t pattern = 0; pattern < std::size_t{1} << kPer; ++pattern) {
    alignas(64) std::array<std::uint8_t, 64> flags{};
    const std::size_t place = pattern % (64 / kPer) * kPer;  // the other registers have marks of their own
    for (std::size_t k = 0; k < flags.size(); ++k) {
      const bool mark = k >= place && k < place + kPer ? (pattern >> (k - place) & 1U) != 0 : random() % 2 != 0;
      flags[k] = mark ? 0xFF : 0;
    }
    const Repeats<R> repeats(flags.data());
    for (std::size_t lane = 0; lane < flags.size(); lane += kPer) {
      std::vector<R> expected;
      std::size_t at = 0;
      for (std::size_t k = 0; k < kPer; ++k) {
        if (k > 0 && flags[lane + k] != 0) ++at;
        expected.push_back(values[lane + at]);
      }
      ASSERT_EQ(this->numbers_of(repeats.repeater(lane)(values.data() + lane)), expected) << pattern << ' ' << lane;
      ASSERT_EQ(repeats.begins(lane), flags[lane] & 1U);
      ASSERT_EQ(repeats.count(lane), at + (flags[lane] & 1U));
    }
  }
}

TEST(Marks, AreTheHighestBitsOfTheBytes) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 1000; ++round) {
    alignas(64) std::array<std::uint8_t, 64> flags{};
    std::uint64_t expected = 0;
    for (std::size_t k = 0; k < flags.size(); ++k) {
      flags[k] = static_cast<std::uint8_t>(random());
      expected |= std::uint64_t{flags[k]} >> 7U << k;
    }
    EXPECT_EQ(marks_of(flags.data()), expected);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes

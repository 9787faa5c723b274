#include "mote/lanes/transpose.hpp"

#include <numeric>

#include <gtest/gtest.h>

namespace mote::lanes {
namespace {

template <class R>
void expect_turned_over() {
  constexpr std::size_t kRows = kWidth<R>;
  std::vector<R> from(kRows * (kRows + 3));  // rows at odd addresses
  std::iota(from.begin(), from.end(), R(1));
  std::vector<R> to(from.size());
  transpose<R>([&](std::size_t i) { return from.data() + i * (kRows + 3); },
               [&](std::size_t k) { return to.data() + k * (kRows + 1); });
  for (std::size_t i = 0; i < kRows; ++i)
    for (std::size_t k = 0; k < kRows; ++k) ASSERT_EQ(to[k * (kRows + 1) + i], from[i * (kRows + 3) + k]);
}

TEST(Transpose, TurnsSquaresOver) {
  expect_turned_over<float>();
  expect_turned_over<double>();
}

TEST(Transpose, FirstLanesAloneAreReadAndWritten) {
  constexpr std::size_t kLanes = kWidth<float>;
  for (std::size_t count = 0; count <= kLanes + 1; ++count) {
    const std::size_t taken = std::min(count, kLanes);
    const std::vector<float> from(taken, 1.0F);
    std::vector<float> to(taken, 0.0F);
    const auto v = load_first(from.data(), count, Vector<float>(7));
    std::array<float, kLanes> lane{};
    v.store(lane.data());
    for (std::size_t i = 0; i < kLanes; ++i) EXPECT_EQ(lane[i], i < taken ? 1.0F : 7.0F);
    store_first(v, count, to.data());
    EXPECT_EQ(to, from);
  }
}

}  // namespace
}  // namespace mote::lanes

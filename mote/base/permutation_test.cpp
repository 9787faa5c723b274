#include "mote/base/permutation.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace mote {
namespace {

TEST(Permutation, VisitsEachPlaceOnce) {
  for (const std::size_t n : {1U, 2U, 3U, 5U, 16U, 17U, 1000U, 1025U}) {
    const Permutation permutation(n, 99);
    std::vector<int> visits(n, 0);
    for (std::size_t j = 0; j < n; ++j) ++visits.at(permutation(j));
    for (const int count : visits) EXPECT_EQ(count, 1);
  }
}

// claim    over keys, j goes to every place equally often
// referee  chi-square with 19 * 19 degrees of freedom: 361 +- 26.9
// risk     1e-6 (|z| < 4.89); the twin (the identity) fails by hundreds of standard deviations
TEST(Permutation, SpreadsEvenlyOverKeys) {
  constexpr std::size_t kPlaces = 20;
  constexpr int kKeys = 20000;
  const auto chi_square = [&](auto&& place) {
    std::vector<double> count(kPlaces * kPlaces, 0);
    for (int key = 0; key < kKeys; ++key)
      for (std::size_t j = 0; j < kPlaces; ++j) count[j * kPlaces + place(static_cast<std::uint64_t>(key), j)] += 1;
    double sum = 0;
    for (const double c : count) sum += (c - kKeys / 20.0) * (c - kKeys / 20.0) / (kKeys / 20.0);
    return sum;
  };
  EXPECT_NEAR(chi_square([](std::uint64_t key, std::size_t j) { return Permutation(kPlaces, key)(j); }), 361,
              4.89 * std::sqrt(2 * 361.0));
  EXPECT_GT(chi_square([](std::uint64_t, std::size_t j) { return j; }), 1e5);
}

}  // namespace
}  // namespace mote

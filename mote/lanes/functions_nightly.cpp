#include "mote/lanes/functions_laws.hpp"

namespace mote::lanes {
namespace {

TEST(Functions, KeepTheirBoundsForEveryFloat) {
  for (const auto& law : unary_laws<float>()) expect_within(law, every_float(1));
  expect_atan2_within<float>(100'000'000);
  expect_quotient_within<float>(100'000'000);
}

// 10^9 points each would take the scalar library hours: 10^7, half of them of the sizes that models meet
TEST(Functions, KeepTheirBoundsForTenMillionDoubles) {
  for (const auto& law : unary_laws<double>()) expect_within(law, doubles(10'000'000));
  expect_atan2_within<double>(10'000'000);
  expect_quotient_within<double>(10'000'000);
}

}  // namespace
}  // namespace mote::lanes

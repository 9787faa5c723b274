#include "mote/base/log_gamma.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

// referee  Gamma(n) = (n - 1)!, Gamma(1/2) = sqrt(pi), Gamma(x + 1) = x Gamma(x)
TEST(LogGamma, IsThatOfFactorialsAndHalves) {
  double factorial = 1;
  for (int n = 1; n <= 20; factorial *= n++)
    EXPECT_NEAR(log_gamma(n), std::log(factorial), 1e-14 * std::log(factorial) + 1e-15);
  EXPECT_NEAR(log_gamma(0.5), 0.5 * std::log(kPi), 1e-15);
  for (const double x : {0.01, 0.3, 1.7, 12.5, 400.25})
    EXPECT_NEAR(log_gamma(x + 1), log_gamma(x) + std::log(x), 1e-13 * (1 + std::abs(log_gamma(x + 1)))) << x;
}

}  // namespace
}  // namespace mote

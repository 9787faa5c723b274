#include "mote/filter/dual.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

struct Rule {
  std::string name;
  std::function<Dual(Dual, Dual)> dual;
  std::function<double(double, double)> plain;
};

/// An expression of a and b in both number types.
#define MOTE_RULE(expression)                                   \
  Rule {                                                        \
#expression, [](Dual a, Dual b) {                             \
      using namespace numbers;                                  \
      static_cast<void>(b);                                     \
      return expression;                                        \
    }, [](double a, double b) {                                 \
      using namespace numbers;                                  \
      static_cast<void>(b);                                     \
      return expression;                                        \
    } \
  }

// claim    the slope is the derivative along the direction (1, -2)
// referee  central differences with steps of 1e-6: their error is about 1e-10
// design   points on both sides of zero where the function allows
TEST(Dual, SlopesAreDerivatives) {
  const std::vector<Rule> rules{MOTE_RULE(a + b),           MOTE_RULE(a - b),
                                MOTE_RULE(a * b),           MOTE_RULE(a / b),
                                MOTE_RULE(-a * b),          MOTE_RULE(sqrt(a * a + b * b)),
                                MOTE_RULE(exp(a) * b),      MOTE_RULE(log(a * a)),
                                MOTE_RULE(sin(a) + cos(b)), MOTE_RULE(tan(a)),
                                MOTE_RULE(atan(a * b)),     MOTE_RULE(atan2(a, b)),
                                MOTE_RULE(abs(a) * abs(b)), MOTE_RULE(a * floor(b)),
                                MOTE_RULE(wrap(a * b)),     MOTE_RULE(select(less(a, b), a * a, b * b * b))};
  constexpr double kStep = 1e-6;
  for (const Rule& rule : rules)
    for (const auto& [a, b] : {std::pair{0.7, 1.3}, {-0.4, 2.2}, {1.1, -0.3}, {-3.3, -1.7}}) {
      const Dual got = rule.dual(Dual(a, 1), Dual(b, -2));
      const double slope = (rule.plain(a + kStep, b - 2 * kStep) - rule.plain(a - kStep, b + 2 * kStep)) / (2 * kStep);
      EXPECT_EQ(got.value, rule.plain(a, b)) << rule.name;
      EXPECT_NEAR(got.slope, slope, 1e-7 * (1 + std::abs(slope))) << rule.name << " at " << a << ", " << b;
    }
}

TEST(Dual, ConstantsHaveNoSlope) {
  EXPECT_EQ(Dual(3.0).slope, 0);
  EXPECT_EQ((Dual(3.0) * Dual(2, 1)).slope, 3);
}

}  // namespace
}  // namespace mote

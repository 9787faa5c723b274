#include "mote/lanes/functions_laws.hpp"

namespace mote::lanes {
namespace {

// One float in 4099, and a million doubles of every size: the nightly test visits every float and 10^9 doubles.
TEST(Functions, KeepTheirBoundsInFloat) {
  for (const auto& law : unary_laws<float>()) expect_within(law, every_float(4099));
  expect_atan2_within<float>(500000);
  expect_quotient_within<float>(500000);
}

TEST(Functions, KeepTheirBoundsInDouble) {
  for (const auto& law : unary_laws<double>()) expect_within(law, doubles(500000));
  expect_atan2_within<double>(500000);
  expect_quotient_within<double>(500000);
}

TEST(Functions, TwinAWrongCoefficientIsCaught) {
  Law<float> wrong = unary_laws<float>()[0];
  wrong.vector = [](const Vector<float>& x) { return exp(x) * Vector<float>(1.000001F); };
  EXPECT_GT(worst(wrong, every_float(4099)).ulps, wrong.bound);
}

template <class R>
void expect_special_values() {
  using V = Vector<R>;
  const R inf = std::numeric_limits<R>::infinity();
  const R nan = std::numeric_limits<R>::quiet_NaN();
  const R zero = 0;
  const R one = 1;
  for (const auto& law : unary_laws<R>())
    for (const R x :
         {inf, -inf, nan, zero, -zero, std::numeric_limits<R>::max(), std::numeric_limits<R>::denorm_min()}) {
      const R got = first(law.vector(V(x)));
      const auto expected = static_cast<R>(law.exact(static_cast<Wider<R>>(x)));
      EXPECT_TRUE(got == expected || (std::isnan(got) && std::isnan(expected)) ||
                  ulps(got, law.exact(static_cast<Wider<R>>(x))) <= law.bound)
          << law.name << "(" << x << ") = " << got;
    }
  for (const R y : {inf, -inf, nan, zero, -zero, one, -one})
    for (const R x : {inf, -inf, nan, zero, -zero, one, -one}) {
      const R ratio = first(V(y) / V(x));
      EXPECT_TRUE(ratio == y / x || (std::isnan(ratio) && std::isnan(y / x))) << y << " / " << x << " = " << ratio;
      const R angle = first(atan2(V(y), V(x)));
      EXPECT_TRUE(std::abs(angle - std::atan2(y, x)) < 1e-6 || (std::isnan(angle) && (std::isnan(x) || std::isnan(y))))
          << "atan2(" << y << ", " << x << ") = " << angle;
    }
}

TEST(Functions, TreatSpecialValuesAsTheStandardLibrary) {
  expect_special_values<float>();
  expect_special_values<double>();
}

TEST(Functions, LogsOfUniformNumbersKeepTheirError) {
  for (std::uint32_t k = 0; k < (1U << 23U); k += 17) {
    const float u = (static_cast<float>(k) + 0.5F) * 0x1p-23F;
    const double exact = std::log(static_cast<double>(u));
    ASSERT_NEAR(first(log_uniform(Vector<float>(u))), exact, 2e-6 - 6e-8 * exact) << u;
    ASSERT_NEAR(first(log_uniform(Vector<double>(u))), exact, -3e-16 * exact) << u;
  }
}

TEST(Functions, WeightsKeepTheirRelativeError) {
  for (double t = -120; t <= 0; t += 0.001) {
    EXPECT_NEAR(first(exp2_weight(Vector<float>(t))) / std::exp2(static_cast<float>(t)), 1, 3e-7) << t;
    EXPECT_NEAR(first(exp2_weight(Vector<double>(t))) / std::exp2(t), 1, 2e-14) << t;
  }
  EXPECT_EQ(first(exp2_weight(Vector<float>(-kInfinity))), 0.0F);
  EXPECT_EQ(first(exp2_weight(Vector<double>(-kInfinity))), 0.0);
  EXPECT_TRUE(std::isnan(first(exp2_weight(Vector<float>(kNaN)))));
  EXPECT_TRUE(std::isnan(first(exp2_weight(Vector<double>(kNaN)))));
}

}  // namespace
}  // namespace mote::lanes

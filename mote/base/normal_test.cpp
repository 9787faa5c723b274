#include "mote/base/normal.hpp"

#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <gtest/gtest.h>

namespace mote {
namespace {

// referee  Boost.Math's normal distribution function, evaluated at our quantile
TEST(StandardNormalQuantile, InvertsTheDistributionFunctionToTheLastDigits) {
  const boost::math::normal standard;
  for (double p = 1e-290; p < 0.5; p *= 1.37) {
    const double z = standard_normal_quantile(p);
    // d log Phi / dz is about |z| in the tail, so a relative error e in z is |z|^2 e in p
    EXPECT_NEAR(boost::math::cdf(standard, z) / p, 1.0, 1e-15 * (4 + 3 * z * z)) << p;
  }
  for (double p = 0.001; p < 0.5; p += 0.01)
    EXPECT_NEAR(standard_normal_quantile(1 - p), -standard_normal_quantile(p), 1e-13);
  EXPECT_EQ(standard_normal_quantile(0.5), 0.0);
  EXPECT_NEAR(standard_normal_quantile(0.975), 1.959963984540054, 1e-15);
}

TEST(NormalFromBits, ReachesBeyondNineSigmaAndIsSymmetric) {
  EXPECT_GT(-normal_from_bits(std::uint64_t{0}), -10.0);
  EXPECT_GT(std::abs(normal_from_bits(std::uint64_t{0})), 9.0);
  for (const std::uint64_t bits : {0ULL, 1ULL, 12345678901234567ULL, (1ULL << 63U) - 1}) {
    EXPECT_EQ(normal_from_bits(bits), -normal_from_bits(bits | (1ULL << 63U)));
  }
}

TEST(NormalFromBits, FloatTailIsRefinedBeyondSixSigma) {
  EXPECT_GT(std::abs(normal_from_bits(std::uint32_t{0}, std::uint64_t{0})), 9.0F);
  EXPECT_LT(std::abs(normal_from_bits(std::uint32_t{0}, ~std::uint64_t{0})), 6.4F);
  EXPECT_LT(std::abs(normal_from_bits(std::uint32_t{1U << 15U}, std::uint64_t{0})), 4.4F);
}

TEST(UniformFromBits, IsOpenAndSymmetric) {
  EXPECT_GT(uniform_from_bits(std::uint64_t{0}), 0.0);
  EXPECT_LT(uniform_from_bits(~std::uint64_t{0}), 1.0);
  EXPECT_EQ(uniform_from_bits(~std::uint64_t{0}), 1.0 - uniform_from_bits(std::uint64_t{0}));
  EXPECT_GT(uniform_from_bits(std::uint32_t{0}), 0.0F);
  EXPECT_LT(uniform_from_bits(~std::uint32_t{0}), 1.0F);
}

TEST(IndexFromBits, CoversItsRange) {
  EXPECT_EQ(index_from_bits(std::uint64_t{0}, std::uint64_t{7}), 0U);
  EXPECT_EQ(index_from_bits(~std::uint64_t{0}, std::uint64_t{7}), 6U);
  EXPECT_EQ(index_from_bits(std::uint32_t{0}, std::uint32_t{7}), 0U);
  EXPECT_EQ(index_from_bits(~std::uint32_t{0}, std::uint32_t{7}), 6U);
}

}  // namespace
}  // namespace mote

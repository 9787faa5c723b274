#include "mote/model/densities.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <gtest/gtest.h>

namespace mote {
namespace {

// referee  Boost.Math
TEST(Densities, AgreeWithBoost) {
  for (const double e : {-3.0, 0.0, 0.2, 8.0}) {
    EXPECT_NEAR(normal_log_density(e, 4.0), std::log(boost::math::pdf(boost::math::normal(0, 2), e)), 1e-12);
    EXPECT_NEAR(student_log_density(e, 0.5, 3.5),
                std::log(boost::math::pdf(boost::math::students_t(3.5), e / 0.5) / 0.5), 1e-12);
  }
}

// referee  the difference quotient: weight times residual is the slope of the -log density
TEST(Densities, WeightResidualsByTheSlope) {
  const double h = 1e-5;
  for (const double e : {-3.0, 0.2, 8.0}) {
    const double slope = (student_log_density(e - h, 1, 3.5) - student_log_density(e + h, 1, 3.5)) / (2 * h);
    EXPECT_NEAR(student_weight(e, 3.5) * e, slope, 1e-8);
    EXPECT_EQ(student_weight(e, 0), 1) << "a normal error";
  }
}

}  // namespace
}  // namespace mote

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

}  // namespace
}  // namespace mote

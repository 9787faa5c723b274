#include "mote/filter/kalman.hpp"

#include <gtest/gtest.h>

#include "mote/filter/estimate.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

using Row1 = std::vector<Row<double>>;
Row1 seen(double y) { return {Row<double>::of({y})}; }

template <class Transform>
class KalmanFilters : public ::testing::Test {};
using Transforms = ::testing::Types<Tangent, Unscented>;
TYPED_TEST_SUITE(KalmanFilters, Transforms);

TYPED_TEST(KalmanFilters, GivePointsWithTheMomentsOfTheLaw) {
  for (const std::size_t points : {1U, 3U, 1000U}) {
    KalmanFilter<Bearings, TypeParam> filter({}, points, OnCollapse::kStop);
    const auto y = std::vector{Row<double>::of({0.75, 0, 0, 0})};
    for (Step t = 1; t <= 5; ++t) {
      EXPECT_EQ(filter.update(t, y).ess, static_cast<double>(filter.weighted().size()));
      for (std::size_t d = 0; d < 4; ++d) {
        const auto i = static_cast<Eigen::Index>(d);
        const Moments moments = component_moments(filter.weighted(), d, false);
        EXPECT_NEAR(moments.mean, filter.law().mean(i), 1e-14);
        EXPECT_NEAR(moments.sd, std::sqrt(filter.law().covariance()(i, i)), 1e-14);
      }
    }
  }
}

TYPED_TEST(KalmanFilters, LeaveOutWhatIsMissing) {
  const Doa model{{}, 3};
  KalmanFilter<Doa, TypeParam> with_gaps(model, 10, OnCollapse::kStop);
  KalmanFilter<Doa, TypeParam> single(Doa{}, 10, OnCollapse::kStop);
  const auto gaps = std::vector{Row<double>{{kNaN, 0.4, kNaN}, {false, true, false}}, blank_row(model)};
  for (Step t = 1; t <= 5; ++t)
    EXPECT_NEAR(with_gaps.update(t, gaps).log_evidence, single.update(t, seen(0.4)).log_evidence, 1e-12);
  EXPECT_LT((with_gaps.law().mean - single.law().mean).norm(), 1e-12);
}

// A scene turned by half a turn, so that the target crosses the cut of the bearings, is filtered alike.
TYPED_TEST(KalmanFilters, KnowNoCutOfTheBearings) {
  Bearings ahead;
  ahead.p.x0 = 0.3;
  ahead.p.y0 = 0.02;
  Bearings behind = ahead;
  behind.p.x0 *= -1;
  behind.p.vx0 *= -1;
  behind.p.y0 *= -1;
  behind.p.vy0 *= -1;
  KalmanFilter<Bearings, TypeParam> a(ahead, 10, OnCollapse::kStop);
  KalmanFilter<Bearings, TypeParam> b(behind, 10, OnCollapse::kStop);
  for (Step t = 1; t <= 10; ++t) {
    const double bearing = 0.06 - 0.02 * t;
    const double turned = numbers::wrap(bearing + kPi);
    const double evidence = a.update(t, std::vector{Row<double>::of({bearing, 0, 0, 0})}).log_evidence;
    EXPECT_NEAR(b.update(t, std::vector{Row<double>::of({turned, 0, 0, 0})}).log_evidence, evidence, 1e-9);
    EXPECT_LT((a.law().mean + b.law().mean).norm(), 1e-12);
  }
}

TYPED_TEST(KalmanFilters, KnowNoCutOfTheStates) {
  DoaParameters start;
  start.theta0 = 3.1;
  start.phi0 = -3.1;
  KalmanFilter<Doa, TypeParam> filter(Doa{start}, 1000, OnCollapse::kStop);
  for (Step t = 1; t <= 5; ++t) filter.update(t, seen(-3.1));
  const Moments theta = component_moments(filter.weighted(), 0, true);
  EXPECT_NEAR(numbers::wrap(theta.mean - kPi), 0, 0.1);
  EXPECT_LT(theta.sd, 0.1);
  for (const Eigen::Index d : {0, 2}) EXPECT_LE(std::abs(filter.law().mean(d)), kPi);
}

TYPED_TEST(KalmanFilters, ReportAnObservationOfDensityZero) {
  const LocalLevel model{{1, 2, 5, 4}};
  for (const OnCollapse policy : {OnCollapse::kStop, OnCollapse::kKeep, OnCollapse::kReset}) {
    KalmanFilter<LocalLevel, TypeParam> filter(model, 10, policy);
    filter.update(1, seen(4));
    KalmanFilter<LocalLevel, TypeParam> predicted = filter;
    predicted.predict(2);
    const StepReport report = filter.update(2, seen(1e300));
    EXPECT_TRUE(report.collapsed);
    EXPECT_EQ(report.log_evidence, -kInfinity);
    const bool reset = policy == OnCollapse::kReset;
    EXPECT_NEAR(filter.law().mean(0), reset ? 5 : predicted.law().mean(0), 1e-12);
    EXPECT_NEAR(filter.law().covariance()(0, 0), reset ? 4 : predicted.law().covariance()(0, 0), 1e-12);
    EXPECT_TRUE(std::isfinite(filter.update(3, seen(4)).log_evidence));
  }
}

// Without noise and without doubt, the state is known: no covariance to divide by.
TYPED_TEST(KalmanFilters, TakeLawsWithoutSpread) {
  KalmanFilter<Ungm<1>, TypeParam> filter(Ungm<1>{{0.5, 1.2, 0, 1, 0}}, 10, OnCollapse::kStop);
  EXPECT_NEAR(filter.update(1, seen(3.0)).log_evidence, normal_log_density(3.0 - 64.0 / 20, 1), 1e-12);
  EXPECT_NEAR(filter.law().mean(0), 8, 1e-12);
  EXPECT_NEAR(filter.law().covariance()(0, 0), 0, 1e-12);
}

TEST(KalmanFilter, RefusesNoiseThatIsNotMadeOfNormalNumbers) {
  Bearings model;
  EXPECT_TRUE(has_normal_noise(model));
  model.p.dof = 3;
  EXPECT_FALSE(has_normal_noise(model));
  EXPECT_THROW(make_ekf(model, 10), std::invalid_argument);
  EXPECT_THROW(make_ukf(model, 10), std::invalid_argument);
}

}  // namespace
}  // namespace mote

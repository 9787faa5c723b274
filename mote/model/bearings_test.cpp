#include "mote/model/bearings.hpp"

#include "mote/model/laws.hpp"

namespace mote {
namespace {

MOTE_MODEL_LAWS(Bearings, Bearings{})
MOTE_MODEL_LAWS(BearingsStudent, Bearings{{0.5, 0.05, 0.02, 0.9, 2, 0.1, 3, -0.1, 0.2, 0.02, 0.2, 0.02, 4}})

/// Errors that repeat, with tails, in a sensor that sees targets too near to its axis.
Bearings robust() {
  Bearings model{{0.5, 0.05, 0.02, 0.9, 2, 0.1, 3, -0.1, 0.2, 0.02, 0.2, 0.02, 4}};
  model.p.correlation = 0.6;
  model.p.distortion = 0.35;
  return model;
}
MOTE_MODEL_LAWS(BearingsRobust, robust())

/// A vehicle: it keeps its course better than its speed, and a speed of its own.
Bearings vehicle() {
  Bearings model = robust();
  model.p.sigma_across = 0.02;
  model.p.cruise = 0.3;
  return model;
}
MOTE_MODEL_LAWS(BearingsVehicle, vehicle())

TEST(Bearings, MovesAsTheCatalogueSays) {
  Bearings model;
  model.p.period = 0.5;
  model.p.damping = 0.9;
  const auto x = model.moved<double>({1, 2, 3, 4}, 0.2, -0.4);
  EXPECT_DOUBLE_EQ(x[0], 1 + 0.5 * 2 + 0.125 * 0.2);
  EXPECT_DOUBLE_EQ(x[1], 0.9 * 2 + 0.5 * 0.2);
  EXPECT_DOUBLE_EQ(x[2], 3 + 0.5 * 4 - 0.125 * 0.4);
  EXPECT_DOUBLE_EQ(x[3], 0.9 * 4 - 0.5 * 0.4);
}

// Northwest at 0.5 m/s: along is (-0.6, 0.8), across, to the left, (-0.8, -0.6).
TEST(Bearings, MovesAVehicleAlongAndAcrossItsCourse) {
  const Bearings model = vehicle();
  const auto x = model.moved<double>({1, -0.3, 3, 0.4}, 0.2, -0.1);
  const double ux = 0.2 * -0.6 - 0.1 * -0.8;
  const double uy = 0.2 * 0.8 - 0.1 * -0.6;
  EXPECT_NEAR(x[0], 1 - 0.5 * 0.3 + 0.125 * ux, 1e-15);
  EXPECT_NEAR(x[1], 0.9 * -0.3 + 0.1 * 0.3 * -0.6 + 0.5 * ux, 1e-15);
  EXPECT_NEAR(x[2], 3 + 0.5 * 0.4 + 0.125 * uy, 1e-15);
  EXPECT_NEAR(x[3], 0.9 * 0.4 + 0.1 * 0.3 * 0.8 + 0.5 * uy, 1e-15);
}

// referee  the noise that was put in, also of a target at rest, whose course is the x axis
TEST(Bearings, ReadsAVehiclesNoiseOffItsVelocities) {
  const Bearings model = vehicle();
  for (const std::array<double, 4>& before : {std::array{1.0, -0.3, 3.0, 0.4}, std::array{1.0, 0.0, 3.0, 0.0}}) {
    const auto x = model.moved<double>(before, 1.3 * model.p.sigma_u, -0.7 * model.p.sigma_across);
    const auto u = model.noise<double>(1, x, before);
    EXPECT_NEAR(u[0], 1.3, 1e-12);
    EXPECT_NEAR(u[1], -0.7, 1e-12);
  }
}

// With both deviations equal and no speed of its own a vehicle is any target: the noise has no direction.
TEST(Bearings, WeighsAVehicleLikeAnyTargetIfItIsOne) {
  Bearings model = robust();
  model.p.sigma_across = model.p.sigma_u;
  const std::array<double, 4> before{1, -0.3, 3, 0.4};
  const std::array<double, 4> x{0.9, -0.25, 3.1, 0.41};
  EXPECT_NEAR(model.log_transition<double>(1, x, before), robust().log_transition<double>(1, x, before), 1e-12);
  model.p.sigma_across *= 2;
  EXPECT_GT(std::abs(model.log_transition<double>(1, x, before) - robust().log_transition<double>(1, x, before)), 0.1)
      << "the twin must fail";
}

TEST(Bearings, SeesRelativeToPositionAndHeadingOfTheSensor) {
  const Bearings model;
  const std::array<double, 4> x{3, 0, 4, 0};
  const double azimuth = std::atan2(4.0 - 2.0, 3.0 - 1.0);
  const auto best = model.log_likelihood<double>(1, x, Row<double>::of({azimuth - 0.7, 1, 2, 0.7}));
  EXPECT_NEAR(best, -std::log(model.p.sigma_r) - 0.5 * std::log(2 * kPi), 1e-9);
  const auto turned = model.log_likelihood<double>(1, x, Row<double>::of({azimuth - 0.7 + 2 * kPi, 1, 2, 0.7}));
  EXPECT_NEAR(turned, best, 1e-9) << "whole turns do not matter";
  EXPECT_LT(model.log_likelihood<double>(1, x, Row<double>::of({azimuth - 0.7 + 0.1, 1, 2, 0.7})), best - 1);
}

// Three quarters of the autocorrelation, seven times the variance: 7 errors tell as much as one.
TEST(Bearings, WidenTheScaleForErrorsThatRepeat) {
  Bearings model;
  model.p.sigma_r = 0.1;
  model.p.correlation = 0.75;
  EXPECT_NEAR(model.scale() * model.scale(), 7 * 0.01, 1e-12);
  const double azimuth = std::atan2(4.0, 3.0);
  EXPECT_NEAR((model.log_likelihood<double>(1, {3, 0, 4, 0}, Row<double>::of({azimuth + 0.2, 0, 0, 0}))),
              normal_log_density(0.2, 0.07), 1e-12);
}

TEST(Bearings, SeesOffAxisTargetsTooNearToTheAxis) {
  Bearings model;
  model.p.distortion = 0.4;
  const double heading = 0.3;
  for (const double relative : {-2.8, -1.2, -0.1, 0.0, 0.7, 1.5, 3.0}) {
    const std::array<double, 4> x{1 + 5 * std::cos(heading + relative), 0, 2 + 5 * std::sin(heading + relative), 0};
    const double seen = relative - 0.4 * std::pow(std::sin(relative), 3);
    EXPECT_NEAR(model.log_likelihood<double>(1, x, Row<double>::of({seen, 1, 2, heading})),
                normal_log_density(0.0, model.p.sigma_r * model.p.sigma_r), 1e-9)
        << relative;
    EXPECT_LE(std::abs(seen), std::abs(relative));
  }
}

TEST(Bearings, WideProposalWeighsInNoiseSpace) {
  const Bearings model;
  const std::array<double, 4> before{0.2, 0.001, 0.3, -0.002};
  const auto x = model.moved<double>(before, 0.0005, -0.0015);
  const double ratio =
      model.log_transition<double>(1, x, before) - BearingsWide{}.log_density<double>(model, 1, x, before, {});
  const double u2 = (0.0005 * 0.0005 + 0.0015 * 0.0015) / (model.p.sigma_u * model.p.sigma_u);
  EXPECT_NEAR(ratio, 2 * std::log(3.0) - 0.5 * u2 * (1 - 1 / 9.0), 1e-9);
}

}  // namespace
}  // namespace mote

#include "mote/model/doa.hpp"

#include "mote/model/laws.hpp"

namespace mote {
namespace {

Doa framed(std::size_t frame) {
  Doa model;
  model.frame = frame;
  return model;
}

Doa repeating(std::size_t frame, double correlation, double dof) {
  Doa model = framed(frame);
  model.p.correlation = correlation;
  model.p.dof = dof;
  return model;
}

MOTE_MODEL_LAWS(Doa, framed(6))
MOTE_MODEL_LAWS(DoaCorrelated, repeating(6, 0.85, 0))
MOTE_MODEL_LAWS(DoaStudent, repeating(6, 0.85, 4))

TEST(Doa, KeepsTheQuadrantOfTheUndisturbedDirection) {
  const Doa model;
  laws::ListedDraw<double> still{std::vector<double>(3, 0.0), {}};
  const std::array<double, 3> behind{2.8, 0.05, 0.8};
  const auto x = model.next<double>(1, behind, still);
  const double expected = std::atan2(std::sin(2.8) + 0.05 * std::sin(0.8), std::cos(2.8) + 0.05 * std::cos(0.8));
  EXPECT_NEAR(x[0], expected, 1e-12);
  EXPECT_NEAR(x[1], 0.05 / std::sqrt(1 + 0.0025 + 0.1 * std::cos(2.0)), 1e-12);
}

// referee  quadrature over theta: the density with its Jacobian integrates to one on its branch and vanishes on the
// other
TEST(Doa, ThetaDensityIntegratesToOne) {
  Doa model;
  model.p.sigma_theta = 0.3;
  const std::array<double, 3> before{2.5, 0.1, 0.4};
  laws::ListedDraw<double> still{std::vector<double>(3, 0.0), {}};
  auto x = model.next<double>(1, before, still);
  const double rest = normal_log_density(0.0, model.p.sigma_q * model.p.sigma_q) +
                      normal_log_density(0.0, model.p.sigma_phi * model.p.sigma_phi);
  double mass = 0;
  const double h = 1e-4;
  for (x[0] = -kPi + h / 2; x[0] < kPi; x[0] += h) {
    const double density = std::exp(model.log_transition<double>(1, x, before) - rest);
    if (std::cos(x[0]) > 0) {
      EXPECT_EQ(density, 0.0);
    } else {
      mass += density * h;
    }
  }
  EXPECT_NEAR(mass, 1, 1e-4);
}

// A frame of n equal errors with correlation c is one error of variance sigma_o^2 (1 + (n - 1) c) / n, whatever the
// rest.
TEST(Doa, AFrameOfRepeatedErrorsTellsLessThanItsLength) {
  const Doa model = repeating(6, 0.85, 0);
  const Row<double> y = Row<double>::of({0.1, 0.2, 0.3, 0.1, 0.2, 0.3});
  const double mean_variance = 0.05 * 0.05 * (1 + 5 * 0.85) / 6;
  const auto at = [&](double theta) { return model.log_likelihood<double>(1, {theta, 0, 0}, y); };
  EXPECT_NEAR(at(0.25) - at(0.2), -0.5 * 0.05 * 0.05 / mean_variance, 1e-9);
  const Row<double> twice{{0.1, kNaN, 0.3, kNaN, kNaN, kNaN}, {true, false, true, false, false, false}};
  const double two = 0.05 * 0.05 * (1 + 0.85) / 2;
  const auto seen = [&](double theta) { return model.log_likelihood<double>(1, {theta, 0, 0}, twice); };
  EXPECT_NEAR(seen(0.25) - seen(0.2), -0.5 * 0.05 * 0.05 / two, 1e-9) << "fields that are not seen do not count";
}

TEST(Doa, OneDirectionIsTheUnivariateDensity) {
  const Row<double> y = Row<double>::of({0.3});
  EXPECT_NEAR((repeating(1, 0.5, 4).log_likelihood<double>(1, {0.2, 0, 0}, y)), student_log_density(0.1, 0.05, 4),
              1e-12);
  EXPECT_NEAR((repeating(1, 0.5, 0).log_likelihood<double>(1, {0.2, 0, 0}, y)), normal_log_density(0.1, 0.0025), 1e-12);
}

TEST(Doa, WrapsTheResidual) {
  const Doa model = framed(1);
  const auto near = model.log_likelihood<double>(1, {kPi - 0.01, 0, 0}, Row<double>::of({-kPi + 0.01}));
  EXPECT_NEAR(near, normal_log_density(0.02, 0.0025), 1e-9);
}

}  // namespace
}  // namespace mote

// Behaviours: curves, fits against the simulator, dies, weights.

#include "mote/analog/behaviour.hpp"

#include <gtest/gtest.h>

#include "mote/analog/characterise.hpp"
#include "mote/analog/simulation.hpp"
#include "mote/analog/weights.hpp"

namespace mote::analog {
namespace {

std::vector<double> values_of(const std::function<double(double)>& function, int steps) {
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) values.push_back(function(kRange * (2.0 * k / steps - 1)));
  return values;
}

Behaviour behaviour_of(Function function, const std::function<double(double)>& transfer) {
  return {{.function = function}, Curve(values_of(transfer, 400)), {}, {}, {}};
}

TEST(Curve, GoesThroughItsPointsAndStaysOutside) {
  const Curve curve(values_of([](double x) { return std::atan(x); }, 200));
  for (int k = -100; k <= 100; ++k) EXPECT_NEAR(curve(k / 10.0), std::atan(k / 10.0), 1e-12);
  for (double x = -9.9; x < 9.9; x += 0.013) EXPECT_NEAR(curve(x), std::atan(x), 1e-5);
  EXPECT_EQ(curve(1000), curve(kRange));
  EXPECT_EQ(curve(-1000), curve(-kRange));
  EXPECT_EQ(Curve()(3), 0);
}

TEST(Behaviour, KnowsItsErrors) {
  const Behaviour off = behaviour_of(Function::kArctan, [](double x) { return std::atan(x) + 0.01; });
  EXPECT_NEAR(off.facts().rms, 0.01, 1e-9);
  EXPECT_NEAR(off.facts().worst, 0.01, 1e-9);
}

// claim    a behaviour is the circuit within its stated residual
// referee  ngspice, at points that are neither fitted nor those of the residual
// twin     the circuit at another I_a is not
TEST(Behaviour, IsTheCircuitWithinItsResidual) {
  for (const Function function : {Function::kArctan, Function::kGaussian}) {
    const Behaviour behaviour = characterised(function, 1e-9, Level::kRealistic, {}, Detail::kTransfer);
    const auto farthest = [&](double ia_a) {
      const Sweep fresh = swept(translinear(function), {Level::kRealistic, ia_a}, 37);
      double far = 0;
      for (std::size_t k = 0; k < fresh.x.size(); ++k)
        far = std::max(far, std::abs(behaviour(fresh.x[k]) - fresh.y[k]));
      return far;
    };
    EXPECT_LT(behaviour.facts().residual, 1e-5) << name_of(function);
    EXPECT_LE(farthest(1e-9), behaviour.facts().residual) << name_of(function);
    EXPECT_GT(farthest(10e-9), 10 * behaviour.facts().residual) << name_of(function);
  }
}

// claim    two circuits of one die differ by numbers of their own
TEST(Behaviour, DrawsEachCircuitOfADieByItself) {
  const std::vector<double> sds(3, 1.0);
  const auto arctan = deviations_of_die(Function::kArctan, sds, 1, 1);
  EXPECT_EQ(arctan, deviations_of_die(Function::kArctan, sds, 1, 1));
  const auto gaussian = deviations_of_die(Function::kGaussian, sds, 1, 1);
  for (std::size_t d = 0; d < sds.size(); ++d) EXPECT_NE(arctan[d], gaussian[d]);
}

// claim    a die is what ngspice finds when all its devices are off at once, to second order
// referee  ngspice
// twin     another die is farther away
TEST(Behaviour, HasDies) {
  const Behaviour nominal = characterised(Function::kArctan, 10e-9, Level::kRealistic);
  const Dies dies = simulated_dies(Function::kArctan, 10e-9, {}, 7, 3);
  std::vector<double> linear;
  for (std::uint32_t die = 1; die <= 3; ++die) linear.push_back(nominal.on_die(7, die).facts().rms);
  EXPECT_EQ(nominal.on_die(7, 2).facts().rms, linear[1]) << "the same address, the same die";
  EXPECT_NE(nominal.on_die(8, 2).facts().rms, linear[1]);
  std::sort(linear.begin(), linear.end());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(linear[k], dies.rms[k], 3e-4 + 0.02 * dies.rms[k]);
  EXPECT_GT(linear[2] - linear[0], 1e-3);
  EXPECT_EQ(dies.yield(dies.rms[1]), 2.0 / 3);
  EXPECT_GT(nominal.noise_sd(1), 1e-4);
  EXPECT_LT(nominal.noise_sd(1), 2e-2);
}

// claim    an arctan that is off by 0.005 rad shifts the weights' mode by that
// referee  exact functions
TEST(Weights, ShiftAsTheArctanErrs) {
  const Behaviour gaussian = behaviour_of(Function::kGaussian, [](double x) { return std::exp(-x * x / 2); });
  for (const double off : {0.0, 0.005}) {
    const Behaviour arctan = behaviour_of(Function::kArctan, [&](double x) { return std::atan(x) + off; });
    for (const double sigma : {0.00506, 0.0489}) {
      const WeightCurve curve = weight_curve(arctan, gaussian, 0.59, sigma);
      EXPECT_NEAR(curve.analog_shift_rad, -off, 2e-3 * sigma);
      EXPECT_NEAR(curve.exact[curve.exact.size() / 2], 1, 1e-4);
      EXPECT_LT(std::abs(curve.approximation_shift_rad), 1e-3);
    }
  }
}

}  // namespace
}  // namespace mote::analog

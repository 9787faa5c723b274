// Circuits: their identities, their equations, their currents.

#include <gtest/gtest.h>

#include "mote/analog/simulation.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::analog {
namespace {

constexpr Function kBoth[] = {Function::kArctan, Function::kGaussian};

std::vector<std::string> mite_names(const Translinear& circuit) {
  std::vector<std::string> names;
  for (const Mite& mite : circuit.mites) names.push_back(mite.name);
  return names;
}

/// The largest |sum of c_k ln(I_k / (width_k I_s))| of a circuit's loops over the input.
double worst_identity(Function function, Level level) {
  const Translinear circuit = translinear(function);
  const Sweep sweep = swept(circuit, {level, 10e-9}, 10, false, {mite_names(circuit)});
  double worst = 0;
  for (const std::vector<int>& loop : loops(circuit))
    for (std::size_t x = 0; x < sweep.x.size(); ++x) {
      double sum = 0;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const double unit = circuit.mites[k].width * preexponential_current(kMite, 27);
        sum += loop[k] * std::log(sweep.current_a.at(circuit.mites[k].name)[x] / unit);
      }
      worst = std::max(worst, std::abs(sum));
    }
  return worst;
}

TEST(Circuits, HaveLoopsWhoseGatesCancel) {
  for (const Function function : kBoth) {
    const Translinear circuit = translinear(function);
    const auto found = loops(circuit);
    EXPECT_GE(found.size(), 5U);
    for (const std::vector<int>& loop : found) {
      std::map<std::string, int> sum;
      for (std::size_t k = 0; k < loop.size(); ++k)
        for (const std::string& gate : circuit.mites[k].gates) sum[gate] += loop[k];
      for (const auto& [gate, times] : sum) EXPECT_EQ(times, 0) << gate;
    }
  }
}

// claim    the translinear identity holds on the ideal law to 1e-9
// referee  the identity itself, of the currents that ngspice finds
// twin     transistors with finite output resistance break it
TEST(Circuits, KeepTheirIdentities) {
  for (const Function function : kBoth) {
    EXPECT_LT(worst_identity(function, Level::kIdeal), 1e-9) << name_of(function);
    EXPECT_GT(worst_identity(function, Level::kRealistic), 1e-3) << name_of(function);
  }
}

// referee  the closed form
TEST(Circuits, ComputeTheirFormulasIdeally) {
  for (const Function function : kBoth)
    for (const double ia_a : {0.1e-9, 20e-9}) {
      const Sweep sweep = swept(translinear(function), {Level::kIdeal, ia_a}, 40);
      ASSERT_EQ(sweep.x.size(), 81U);
      EXPECT_EQ(sweep.x.front(), -kRange);
      EXPECT_EQ(sweep.x.back(), kRange);
      for (std::size_t k = 0; k < sweep.x.size(); ++k)
        EXPECT_NEAR(sweep.y[k], approximation(function, sweep.x[k]), 2e-7) << name_of(function) << " " << sweep.x[k];
    }
}

TEST(Circuits, HaveFormulasNearTheFunctions) {
  for (double x = -kRange; x <= kRange; x += 0.01) {
    EXPECT_NEAR(approximation(Function::kArctan, x), std::atan(x), 0.0008);
    EXPECT_NEAR(approximation(Function::kGaussian, x), std::exp(-x * x / 2), 0.053);
  }
}

// claim    Kirchhoff's current law: what flows into a node flows out of it; so the supply delivers what its devices
// take referee  sums over the devices at the node
TEST(Circuits, LoseNoCurrent) {
  for (const Function function : kBoth) {
    const Translinear circuit = translinear(function);
    const Setting setting{Level::kRealistic, 10e-9};
    const Sweep sweep = swept(circuit, setting, 10, false, {devices(circuit)});
    for (std::size_t k = 0; k < sweep.x.size(); ++k) {
      const auto current = [&](const std::string& device) { return sweep.current_a.at(device)[k]; };
      std::map<std::string, double> sum;  // into the node
      double supplied = std::max(sweep.x[k], 0.0) * setting.ia_a + current("reference");
      sum[circuit.input] += sweep.x[k] * setting.ia_a;
      for (const Mite& mite : circuit.mites) sum[mite.drain] -= current(mite.name);
      for (const Bias& bias : circuit.biases) {
        sum[bias.node] += current("bias." + bias.node);
        supplied += current("bias." + bias.node);
      }
      for (const Mirror& mirror : circuit.mirrors) {
        sum[mirror.from] += current("in." + mirror.from);
        sum[mirror.to] += current("out." + mirror.from);
        supplied += current("in." + mirror.from) + current("out." + mirror.from);
      }
      for (const auto& [node, total] : sum)
        EXPECT_NEAR(total, node == circuit.output ? sweep.y[k] * setting.ia_a : 0, 1e-7 * supplied) << node;
      EXPECT_NEAR(sweep.power_w[k], 3 * supplied, 1e-6 * 3 * supplied);
    }
  }
}

// claim    loops cancel temperature: from -20 to 85 C the arctan stays within 2 % of 1 rad
TEST(Circuits, StandHeatAndCold) {
  for (const double temperature_c : {-20.0, 85.0}) {
    const Sweep sweep =
        swept(translinear(Function::kArctan), {Level::kRealistic, 10e-9, {.temperature_c = temperature_c}}, 10);
    for (std::size_t k = 0; k < sweep.x.size(); ++k)
      EXPECT_NEAR(sweep.y[k], std::atan(sweep.x[k]), 0.02) << temperature_c;
  }
}

// claim    settling takes time in proportion to 1 / I_a, as the charge on capacitances does
TEST(Circuits, SettleInProportion) {
  const Translinear circuit = translinear(Function::kArctan);
  const double slow = settling_time(circuit, {Level::kIdeal, 1e-9}, 1);
  const double fast = settling_time(circuit, {Level::kIdeal, 10e-9}, 1);
  EXPECT_NEAR(slow / fast, 10, 0.5);
  EXPECT_GT(fast, 1e-6);
}

TEST(Circuits, RefuseTheAbsurd) {
  const auto refused = [](double ia_a, const Conditions& conditions) {
    try {
      refuse_absurd({Level::kRealistic, ia_a, conditions});
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kWrongUse);
      return std::string(refusal.what());
    }
    return std::string("nothing was refused");
  };
  EXPECT_EQ(refused(1, {}), "analog circuit: I_a: expected 0.01 to 100 nA, got 1e+09. The paper's are 0.1 to 20 nA.");
  EXPECT_EQ(refused(-1e-9, {}).find("analog circuit: I_a: expected"), 0U);
  EXPECT_EQ(refused(kNaN, {}).find("analog circuit: I_a: expected"), 0U);
  EXPECT_NE(refused(1e-8, {.temperature_c = 400}).find("temperature: expected -40 to 125"), std::string::npos);
  EXPECT_NE(refused(1e-8, {.supply_v = 0}).find("supply: expected 2.5 to 5.5"), std::string::npos);
}

}  // namespace
}  // namespace mote::analog

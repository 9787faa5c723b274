#include "Vimh_growth.h"
#include "Vimh_local_level.h"
#include "mote/engine/latency.hpp"
#include "mote/hardware/filters/cosim/imh_checks.hpp"

namespace mote::hardware::cosim {
namespace {

struct LocalLevelCircuit {
  using Top = Vimh_local_level;
  static Arithmetic model() { return local_level(); }
  static std::vector<Sight> sights(std::size_t steps, std::uint64_t seed) { return level_sights(steps, seed); }
};
struct GrowthCircuit {
  using Top = Vimh_growth;
  static Arithmetic model() { return growth(); }
  static std::vector<Sight> sights(std::size_t steps, std::uint64_t seed) { return growth_sights(steps, seed); }
};

template <class Circuit>
class ImhCircuit : public ::testing::Test {
 protected:
  void SetUp() override { write_all_tables(); }
};
using Circuits = ::testing::Types<LocalLevelCircuit, GrowthCircuit>;
TYPED_TEST_SUITE(ImhCircuit, Circuits);

TYPED_TEST(ImhCircuit, EqualsTheGoldenModelAtEverySize) {
  const Arithmetic model = TypeParam::model();
  Bench<typename TypeParam::Top> bench(model.formats);
  Imh golden(model, 1);
  std::uint64_t seed = 0;
  for (const ImhRegisters& registers : sizes()) {
    const auto sights = TypeParam::sights(12, ++seed);
    const Outcome outcome = bench.run(registers.particles, sights, written(registers));
    EXPECT_GT(expect_equal(outcome, golden, registers, sights), 0U);
    EXPECT_EQ(outcome.cycles, golden.cycles()) << registers.particles << " of " << registers.proposals();
  }
}

TYPED_TEST(ImhCircuit, EqualsTheGoldenModelForAMillionParticleSteps) {
  const Arithmetic model = TypeParam::model();
  Bench<typename TypeParam::Top> bench(model.formats);
  Imh golden(model, 1);
  const ImhRegisters registers{1000, 1000, 50, false};
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto sights = TypeParam::sights(50, seed);
    compared += expect_equal(bench.run(1000, sights, written(registers), {20, 20, seed}), golden, registers, sights);
  }
  EXPECT_EQ(compared, 1000000 * model.formats.dims);
}

// The law of the architecture, from the engine's own collection of latency laws.
TYPED_TEST(ImhCircuit, TakesTheCyclesOfTheLatencyLaw) {
  const Formats f = TypeParam::model().formats;
  Bench<typename TypeParam::Top> bench(f);
  for (const ImhRegisters& r : {ImhRegisters{200, 200, 0}, ImhRegisters{200, 200, 50}, ImhRegisters{200, 777, 20}}) {
    const auto cycles = [&](std::size_t steps) {
      return bench.run(r.particles, TypeParam::sights(steps, 5), written(r)).cycles;
    };
    const double law = sequential_time(r.proposals(), {1, 1, 1}, {4.0 + f.propose_latency, 1.0 + f.weigh_latency});
    EXPECT_EQ(static_cast<double>(cycles(21) - cycles(1)), 20 * law);
  }
}

TYPED_TEST(ImhCircuit, LosesNothingWhenStreamsPause) {
  const Arithmetic model = TypeParam::model();
  Bench<typename TypeParam::Top> bench(model.formats);
  Imh golden(model, 1);
  for (const unsigned often : {60U, 200U, 254U})
    for (const ImhRegisters& registers : {ImhRegisters{5, 8, 2, false}, ImhRegisters{90, 90, 0, true}}) {
      const auto sights = TypeParam::sights(30, often);
      const Outcome outcome = bench.run(registers.particles, sights, written(registers), {often, often, often});
      expect_equal(outcome, golden, registers, sights);
    }
}

TYPED_TEST(ImhCircuit, BeginsAnewAfterAResetAtAnyTime) {
  const Arithmetic model = TypeParam::model();
  Bench<typename TypeParam::Top> bench(model.formats);
  const ImhRegisters registers{40, 50, 6, false};
  const auto sights = TypeParam::sights(6, 3);
  for (std::uint64_t cycle = 1; cycle < 330; cycle += 23) {
    EXPECT_FALSE(bench.run(40, sights, written(registers), {}, cycle).complete);
    bench.reset();
    Imh golden(model, 1);
    expect_equal(bench.run(40, sights, written(registers)), golden, registers, sights);
    bench.reset();
  }
}

// The twin: another seed must be told apart, in every estimate.
TYPED_TEST(ImhCircuit, IsNotTheGoldenModelOfAnotherSeed) {
  const Arithmetic model = TypeParam::model();
  Bench<typename TypeParam::Top> bench(model.formats);
  Imh golden(model, 2);
  const ImhRegisters registers{100, 100, 0, false};
  golden.start(registers);
  const auto sights = TypeParam::sights(5, 3);
  const Outcome outcome = bench.run(100, sights, written(registers));
  ASSERT_EQ(outcome.estimates.size(), sights.size());
  for (std::size_t k = 0; k < sights.size(); ++k) EXPECT_NE(outcome.estimates[k], golden.step(sights[k].values));
}

}  // namespace
}  // namespace mote::hardware::cosim

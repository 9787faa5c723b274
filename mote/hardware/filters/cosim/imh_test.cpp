#include "Vimh_1_folded.h"
#include "Vimh_2_folded.h"
#include "Vimh_2_in_turn.h"
#include "Vimh_2_overlapped.h"
#include "Vimh_2_private.h"
#include "Vimh_4_banked.h"
#include "Vimh_4_folded.h"
#include "Vimh_4_folded_overlapped.h"
#include "Vimh_4_shared.h"
#include "Vimh_8_folded.h"
#include "Vimh_growth.h"
#include "Vimh_in_turn.h"
#include "Vimh_local_level.h"
#include "Vimh_overlapped.h"
#include "mote/engine/latency.hpp"
#include "mote/hardware/filters/cosim/imh_checks.hpp"

namespace mote::hardware::cosim {
namespace {

struct LocalLevelCircuit {
  using Top = Vimh_local_level;
  static constexpr ImhLanes kLanes{};
  static Arithmetic model() { return local_level(); }
  static std::vector<Sight> sights(std::size_t steps, std::uint64_t seed) { return level_sights(steps, seed); }
};
struct GrowthCircuit {
  using Top = Vimh_growth;
  static constexpr ImhLanes kLanes{};
  static Arithmetic model() { return growth(); }
  static std::vector<Sight> sights(std::size_t steps, std::uint64_t seed) { return growth_sights(steps, seed); }
};
struct TwoPrivateChains : LocalLevelCircuit {
  using Top = Vimh_2_private;
  static constexpr ImhLanes kLanes{2, Parents::kPrivate};
};
struct FourBankedChains : GrowthCircuit {
  using Top = Vimh_4_banked;
  static constexpr ImhLanes kLanes{4, Parents::kBanked};
};
struct FourSharedChains : GrowthCircuit {
  using Top = Vimh_4_shared;
  static constexpr ImhLanes kLanes{4, Parents::kShared};
};
struct EveryThirdCycle : GrowthCircuit {
  using Top = Vimh_in_turn;
  static Arithmetic model() { return growth_every(3); }
};
struct TwoChainsEverySecondCycle : GrowthCircuit {
  using Top = Vimh_2_in_turn;
  static constexpr ImhLanes kLanes{2};
  static Arithmetic model() { return growth_every(2); }
};
struct OnePairBeforeOneChain : LocalLevelCircuit {
  using Top = Vimh_1_folded;
  static constexpr ImhLanes kLanes{.count = 1, .folded = true};
};
struct TwoPairsBeforeOneChain : LocalLevelCircuit {
  using Top = Vimh_2_folded;
  static constexpr ImhLanes kLanes{.count = 2, .folded = true};
};
struct FourPairsBeforeOneChain : GrowthCircuit {
  using Top = Vimh_4_folded;
  static constexpr ImhLanes kLanes{.count = 4, .folded = true};
};
struct EightPairsBeforeOneChain : GrowthCircuit {
  using Top = Vimh_8_folded;
  static constexpr ImhLanes kLanes{.count = 8, .folded = true};
};
struct OverlappedSteps : GrowthCircuit {
  using Top = Vimh_overlapped;
  static constexpr ImhLanes kLanes{.overlapped = true};
};
struct TwoChainsOverlapped : LocalLevelCircuit {
  using Top = Vimh_2_overlapped;
  static constexpr ImhLanes kLanes{.count = 2, .overlapped = true};
};
struct FourPairsOverlapped : GrowthCircuit {
  using Top = Vimh_4_folded_overlapped;
  static constexpr ImhLanes kLanes{.count = 4, .folded = true, .overlapped = true};
};

template <class Circuit>
class ImhCircuit : public ::testing::Test {
 protected:
  static constexpr unsigned kLanes = Circuit::kLanes.count;
  static Imh golden(std::uint64_t seed = 1) { return {Circuit::model(), seed, 0, Circuit::kLanes}; }

  Bench<typename Circuit::Top> bench_{with_tables(Circuit::model().formats), kLanes};
};
using Circuits = ::testing::Types<LocalLevelCircuit, GrowthCircuit, TwoPrivateChains, FourBankedChains,
                                  FourSharedChains, EveryThirdCycle, TwoChainsEverySecondCycle, OnePairBeforeOneChain,
                                  TwoPairsBeforeOneChain, FourPairsBeforeOneChain, EightPairsBeforeOneChain,
                                  OverlappedSteps, TwoChainsOverlapped, FourPairsOverlapped>;
TYPED_TEST_SUITE(ImhCircuit, Circuits);

TYPED_TEST(ImhCircuit, EqualsTheGoldenModelAtEverySize) {
  Imh golden = this->golden();
  std::uint64_t seed = 0;
  for (const ImhRegisters& registers : sizes(this->kLanes)) {
    const auto sights = TypeParam::sights(12, ++seed);
    const Outcome outcome = this->bench_.run(registers.particles, sights, written(registers));
    EXPECT_GT(expect_equal(outcome, golden, registers, sights), 0U);
    EXPECT_EQ(outcome.cycles, golden.cycles())
        << registers.particles << " of " << registers.draws << " + " << registers.burn_in;
  }
}

TYPED_TEST(ImhCircuit, EqualsTheGoldenModelForAMillionParticleSteps) {
  Imh golden = this->golden();
  const ImhRegisters registers{1000, 1000, 50, false};
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto sights = TypeParam::sights(50, seed);
    compared +=
        expect_equal(this->bench_.run(1000, sights, written(registers), {20, 20, seed}), golden, registers, sights);
  }
  EXPECT_EQ(compared, 1000000 * TypeParam::model().formats.dims);
}

// The law of the architecture, from the engine's own collection of latency laws: copies of the chain, pairs of proposer
// and weigher before one chain that decides on all of a row in a cycle, steps that follow one another without a gap.
double law_of(const ImhRegisters& r, const ImhLanes& lanes, const Formats& f) {
  if (lanes.overlapped) return lanes.rows(r);
  const auto before_the_proposal = static_cast<double>(4 + lanes.turn_latency());  // lanes choose memories in turn
  const StageLatencies latencies{before_the_proposal + f.propose_latency,
                                 static_cast<double>(f.weigh_latency + lanes.chain_latency())};
  const double turn = f.interval;
  if (!lanes.folded) return sequential_time(r.draws / lanes.count + r.burn_in, {turn, turn, 1}, latencies);
  const std::uint64_t rows = (r.draws + r.burn_in + lanes.count - 1) / lanes.count;  // the last one may be filled up
  return paired_time(rows * lanes.count, lanes.count, {1, 1, 1.0 / lanes.count}, latencies);
}

TYPED_TEST(ImhCircuit, TakesTheCyclesOfTheLatencyLaw) {
  for (const ImhRegisters& r : {ImhRegisters{400, 400, 0}, ImhRegisters{400, 400, 52}, ImhRegisters{400, 776, 20}}) {
    const auto cycles = [&](std::size_t steps) {
      return this->bench_.run(r.particles, TypeParam::sights(steps, 5), written(r)).cycles;
    };
    const double law = law_of(r, TypeParam::kLanes, TypeParam::model().formats);
    EXPECT_EQ(static_cast<double>(cycles(21) - cycles(1)), 20 * law);
  }
}

TYPED_TEST(ImhCircuit, LosesNothingWhenStreamsPause) {
  Imh golden = this->golden();
  for (const unsigned often : {60U, 200U, 254U})
    for (const ImhRegisters& registers : {ImhRegisters{8, 16, 2, false}, ImhRegisters{88, 88, 0, true}}) {
      const auto sights = TypeParam::sights(30, often);
      const Outcome outcome = this->bench_.run(registers.particles, sights, written(registers), {often, often, often});
      expect_equal(outcome, golden, registers, sights);
    }
}

TYPED_TEST(ImhCircuit, BeginsAnewAfterAResetAtAnyTime) {
  const ImhRegisters registers{40, 50, 6, false};
  const auto sights = TypeParam::sights(6, 3);
  for (std::uint64_t cycle = 1; cycle < 200; cycle += 13) {
    EXPECT_FALSE(this->bench_.run(40, sights, written(registers), {}, cycle).complete);
    this->bench_.reset();
    Imh golden = this->golden();
    expect_equal(this->bench_.run(40, sights, written(registers)), golden, registers, sights);
    this->bench_.reset();
  }
}

// Goals for 50 steps of 1000 particles: at most 16 500 cycles by four lanes, 50 N + 500 where steps overlap.
TYPED_TEST(ImhCircuit, IsThroughWithFiftyStepsInTime) {
  const ImhRegisters registers{1000, 1000, 0, false};
  const std::uint64_t cycles = this->bench_.run(1000, TypeParam::sights(50, 1), written(registers)).cycles;
  std::printf("50 steps of 1000 particles by %u lanes: %lu cycles\n", this->kLanes, cycles);
  const std::uint64_t turn = TypeParam::model().formats.interval;
  EXPECT_LE(cycles, TypeParam::kLanes.overlapped ? 50000 / this->kLanes + 500
                    : this->kLanes == 4          ? 16500
                                                 : turn * 54000);
}

// The twin: another seed must be told apart, in every estimate.
TYPED_TEST(ImhCircuit, IsNotTheGoldenModelOfAnotherSeed) {
  Imh golden = this->golden(2);
  const ImhRegisters registers{100, 100, 0, false};
  golden.start(registers);
  const auto sights = TypeParam::sights(5, 3);
  const Outcome outcome = this->bench_.run(100, sights, written(registers));
  ASSERT_EQ(outcome.estimates.size(), sights.size());
  for (std::size_t k = 0; k < sights.size(); ++k) EXPECT_NE(outcome.estimates[k], golden.step(sights[k].values));
}

}  // namespace
}  // namespace mote::hardware::cosim

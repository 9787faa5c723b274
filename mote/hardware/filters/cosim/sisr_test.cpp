#include "mote/hardware/filters/sisr.hpp"

#include "Vsisr_2_in_turn.h"
#include "Vsisr_2_lanes.h"
#include "Vsisr_4_lanes.h"
#include "Vsisr_growth.h"
#include "Vsisr_in_turn.h"
#include "Vsisr_local_level.h"
#include "Vsisr_merged.h"
#include "Vsisr_pipelined.h"
#include "Vsisr_plain.h"
#include "Vsisr_ranked.h"
#include "Vsisr_ranked_twin.h"
#include "mote/hardware/filters/cosim/imh_checks.hpp"

namespace mote::hardware::cosim {
namespace {

struct LocalLevelCircuit {
  using Top = Vsisr_local_level;
  static constexpr unsigned kLanes = 1;
  static constexpr std::uint64_t kGoal = 54000;
  static Sisr golden(std::uint64_t seed) { return {model(), seed}; }
  static Arithmetic model() { return local_level(); }
  static std::vector<Sight> sights(std::size_t steps, std::uint64_t seed, bool far = true) {
    return level_sights(steps, seed, far);
  }
};
struct GrowthCircuit {
  using Top = Vsisr_growth;
  static constexpr unsigned kLanes = 1;
  static constexpr std::uint64_t kGoal = 54000;
  static Sisr golden(std::uint64_t seed) { return {model(), seed}; }
  static Arithmetic model() { return growth(); }
  static std::vector<Sight> sights(std::size_t steps, std::uint64_t seed, bool far = true) {
    return growth_sights(steps, seed, far);
  }
};
struct TwoLanes : LocalLevelCircuit {
  using Top = Vsisr_2_lanes;
  static constexpr unsigned kLanes = 2;
  static Sisr golden(std::uint64_t seed) { return {model(), seed, 0, kLanes}; }
};
struct FourLanes : GrowthCircuit {
  using Top = Vsisr_4_lanes;
  static constexpr unsigned kLanes = 4;
  static constexpr std::uint64_t kGoal = 16500;
  static Sisr golden(std::uint64_t seed) { return {model(), seed, 0, kLanes}; }
};
struct EveryThirdCycle : GrowthCircuit {
  using Top = Vsisr_in_turn;
  static constexpr std::uint64_t kGoal = 3 * 54000;
  static Sisr golden(std::uint64_t seed) { return {model(), seed}; }
  static Arithmetic model() { return growth_every(3); }
};
struct TwoLanesEverySecondCycle : GrowthCircuit {
  using Top = Vsisr_2_in_turn;
  static constexpr unsigned kLanes = 2;
  static Sisr golden(std::uint64_t seed) { return {model(), seed, 0, kLanes}; }
  static Arithmetic model() { return growth_every(2); }
};
struct PlainCircuit : GrowthCircuit {
  using Top = Vsisr_plain;
  static constexpr std::uint64_t kGoal = 1'800'000;
  static Sisr golden(std::uint64_t seed) { return {model(), seed, 0, PlainLoops{}}; }
};
struct PipelinedCircuit : GrowthCircuit {
  using Top = Vsisr_pipelined;
  static constexpr std::uint64_t kGoal = 210'000;
  static Sisr golden(std::uint64_t seed) { return {model(), seed, 0, PlainLoops{true, false}}; }
};
struct MergedCircuit : GrowthCircuit {
  using Top = Vsisr_merged;
  static constexpr std::uint64_t kGoal = 106'000;
  static Sisr golden(std::uint64_t seed) { return {model(), seed, 0, PlainLoops{true, true}}; }
};

auto sized(std::uint32_t particles) {
  return [=](auto& top) { top.n_i = static_cast<std::uint16_t>(particles); };
}

std::size_t expect_equal(const Outcome& outcome, Sisr& golden, std::uint32_t particles,
                         const std::vector<Sight>& sights) {
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.estimates.size(), sights.size());
  EXPECT_EQ(outcome.sets.size(), sights.size());
  golden.start(particles);
  std::size_t compared = 0;
  for (std::size_t k = 0; k < std::min(outcome.estimates.size(), outcome.sets.size()); ++k) {
    const Estimate estimate = golden.step(sights[k].values);
    EXPECT_EQ(outcome.estimates[k], estimate) << "step " << k + 1;
    EXPECT_EQ(outcome.sets[k], golden.set()) << "step " << k + 1;
    compared += golden.set().size() * particles;
  }
  return compared;
}

template <class Circuit>
class SisrCircuit : public ::testing::Test {
 protected:
  static Sisr golden(std::uint64_t seed = 1) { return Circuit::golden(seed); }
  static std::uint32_t whole(std::uint32_t n) { return std::max(Circuit::kLanes, n - n % Circuit::kLanes); }

  Bench<typename Circuit::Top> bench_{with_tables(Circuit::model().formats), Circuit::kLanes};
};
using Circuits = ::testing::Types<LocalLevelCircuit, GrowthCircuit, TwoLanes, FourLanes, EveryThirdCycle,
                                  TwoLanesEverySecondCycle, PlainCircuit, PipelinedCircuit, MergedCircuit>;
TYPED_TEST_SUITE(SisrCircuit, Circuits);

TYPED_TEST(SisrCircuit, EqualsTheGoldenModelAndItsCyclesAtEverySize) {
  Sisr golden = this->golden();
  std::uint64_t seed = 0;
  for (const std::uint32_t size : {1U, 2U, 3U, 5U, 8U, 13U, 40U, 250U, 501U, 1000U, 1023U, 1024U}) {
    const std::uint32_t n = this->whole(size);
    const auto sights = TypeParam::sights(25, ++seed);
    const Outcome outcome = this->bench_.run(n, sights, sized(n));
    EXPECT_GT(expect_equal(outcome, golden, n, sights), 0U);
    EXPECT_EQ(outcome.cycles, golden.cycles()) << n;
  }
}

TYPED_TEST(SisrCircuit, EqualsTheGoldenModelForAMillionParticleSteps) {
  Sisr golden = this->golden();
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto sights = TypeParam::sights(50, seed);
    compared += expect_equal(this->bench_.run(1000, sights, sized(1000), {20, 20, seed}), golden, 1000, sights);
  }
  EXPECT_EQ(compared, 1000000 * TypeParam::model().formats.dims);
}

TYPED_TEST(SisrCircuit, LosesNothingWhenStreamsPause) {
  Sisr golden = this->golden();
  for (const unsigned often : {60U, 200U, 254U})
    for (const std::uint32_t n : {4U, 88U}) {
      const auto sights = TypeParam::sights(30, often);
      expect_equal(this->bench_.run(n, sights, sized(n), {often, often, often}), golden, n, sights);
    }
}

TYPED_TEST(SisrCircuit, BeginsAnewAfterAResetAtAnyTime) {
  const auto sights = TypeParam::sights(6, 3);
  for (std::uint64_t cycle = 1; cycle < 200; cycle += 13) {
    EXPECT_FALSE(this->bench_.run(60, sights, sized(60), {}, cycle).complete);
    this->bench_.reset();
    Sisr golden = this->golden();
    expect_equal(this->bench_.run(60, sights, sized(60)), golden, 60, sights);
    this->bench_.reset();
  }
}

// Goals on observations that the model drew itself, for 50 steps of 1000 particles: one lane, four lanes; separate
// loops for comparison, after the table of the paper: before, pipelined, merged.
TYPED_TEST(SisrCircuit, IsThroughWithFiftyStepsInTime) {
  const std::uint64_t cycles = this->bench_.run(1000, TypeParam::sights(50, 1, false), sized(1000)).cycles;
  std::printf("50 steps of 1000 particles: %lu cycles\n", cycles);
  EXPECT_LE(cycles, TypeParam::kGoal);
}

// The twin: another seed must be told apart, in every estimate.
TYPED_TEST(SisrCircuit, IsNotTheGoldenModelOfAnotherSeed) {
  Sisr golden = this->golden(2);
  golden.start(100);
  const auto sights = TypeParam::sights(5, 3);
  const Outcome outcome = this->bench_.run(100, sights, sized(100));
  ASSERT_EQ(outcome.estimates.size(), sights.size());
  for (std::size_t k = 0; k < sights.size(); ++k) EXPECT_NE(outcome.estimates[k], golden.step(sights[k].values));
}

/// Whether a circuit on ranked particles is its golden model, where 1000 of them have a weight, then 64, then others.
template <class Top>
bool resamples_early_rows() {
  Bench<Top> bench(with_tables(ranked().formats));
  Sisr golden(ranked(), 1);
  std::vector<Sight> sights;
  for (const std::int64_t weighty : {1000, 64, 1000, 1, 500, 64, 64, 999, 2, 700})
    sights.push_back(packed({weighty}, {12}));
  const Outcome outcome = bench.run(1000, sights, sized(1000), {}, 100'000);
  golden.start(1000);
  bool equal = outcome.complete && outcome.sets.size() == sights.size();
  for (std::size_t k = 0; equal && k < sights.size(); ++k)
    equal = golden.step(sights[k].values) == outcome.estimates[k] && golden.set() == outcome.sets[k];
  return equal && outcome.cycles == golden.cycles();
}

// claim    rows of particles behind the last child of a step do not count among the next step's: where 32 rows that
// have
//          all children fill the queue, hundreds are unread when the last child has left
// referee  the golden model, which knows of no rows behind
// twin     a circuit that reads them
TEST(SisrRanked, LeavesRowsBehindTheLastChildUnread) {
  EXPECT_TRUE(resamples_early_rows<Vsisr_ranked>());
  EXPECT_FALSE(resamples_early_rows<Vsisr_ranked_twin>()) << "the twin";
}

// Goals for one lane: at most 16 000 and 28 700 cycles for 250 and 500 particles.
TEST(SisrGrowth, IsThroughWithFewerParticlesInLess) {
  Bench<Vsisr_growth> bench(with_tables(growth().formats));
  for (const auto& [n, goal] : std::map<std::uint32_t, std::uint64_t>{{250, 16000}, {500, 28700}}) {
    const std::uint64_t cycles = bench.run(n, growth_sights(50, 1, false), sized(n)).cycles;
    std::printf("50 steps of %u particles: %lu cycles\n", n, cycles);
    EXPECT_LE(cycles, goal);
  }
}

}  // namespace
}  // namespace mote::hardware::cosim

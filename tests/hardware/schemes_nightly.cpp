#include <gtest/gtest.h>

#include "mote/app/circuits/simulation.hpp"
#include "tests/hardware/models.hpp"

namespace mote::hardware {
namespace {

/// A circuit that resamples: its architecture, scheme and, in separate loops, how they are joined.
struct Cloud {
  std::string name, architecture;
  Resampler resampler;
  PlainLoops loops = {};
  unsigned lanes = 1;
  std::uint32_t exchange = 0;
  int interval = 1;  ///< cycles from a particle to the next
};

std::vector<Cloud> clouds() {
  using enum Resampler;
  return {{"sisr_residual", "sisr", kResidualSystematic},
          {"sisr_roulette", "sisr", kRoulette},
          {"plain_residual", "sisr-plain", kResidualSystematic},
          {"pipelined_roulette", "sisr-plain", kRoulette, {true, false}},
          {"merged_residual", "sisr-plain", kResidualSystematic, {true, true}},
          {"groups", "groups", kSystematic, {}, 4, 3},
          {"groups_residual", "groups", kResidualSystematic, {}, 8, 1},
          {"groups_roulette", "groups", kRoulette, {}, 2, 512},
          {"sisr_in_turn", "sisr", kSystematic, {}, 1, 0, 2},
          {"sisr_roulette_in_turn", "sisr", kRoulette, {}, 1, 0, 4},
          {"sisr_lanes_in_turn", "sisr-lanes", kSystematic, {}, 4, 0, 3}};
}

struct Target {
  const char *name, *model;
  std::vector<std::string> settings = {};
};

CircuitDesign design_of(const Cloud& cloud) {
  constexpr std::uint32_t kMost = 1024;  // a power of two: the memories are full
  CircuitDesign design;
  for (const Architecture& one : architectures())
    if (one.name == cloud.architecture) design.architecture = &one;
  design.registers.particles = design.registers.draws = kMost;
  design.registers.exchange = cloud.exchange;
  design.lanes = cloud.lanes;
  design.variant = {cloud.resampler, cloud.loops};
  design.interval = cloud.interval;
  return design;
}

/// What a run compared with the golden model, which went on from the run before.
std::uint64_t expect_equal(const FilterCircuit& circuit, Simulator& simulator, Golden& golden,
                           const RunRegisters& registers, const Recording& recording, StreamPauses pauses) {
  const auto observed = observed_by(circuit, recording, "test");
  const CircuitRun run = simulator.run(registers, observed, pauses);
  const Agreement found = agreement(run, golden, registers, observed);
  EXPECT_TRUE(run.complete);
  EXPECT_EQ(found.mismatches, 0U) << registers.particles;
  if (pauses.observations == 0) {
    EXPECT_EQ(found.cycles, found.predicted_cycles) << registers.particles;
  }
  return observed.size() * registers.particles;
}

class SchemesNightly : public ::testing::TestWithParam<Cloud> {};

// claim    circuits that resample by every scheme write their golden model's words and take its cycles; streams that
// pause
//          and a reset in mid-run change no word
// design   four models; 1 particle a lane to as many as the memories hold; 10^6 particle-steps together
// twin     the golden model of another seed
TEST_P(SchemesNightly, EqualTheirGoldenModels) {
  const Target targets[] = {
      {"ungm", "ungm"}, {"ungm2", "ungm", {"copies=2"}}, {"bearings", "bearings"}, {"doa", "doa"}};
  std::uint64_t particle_steps = 0;
  for (const Target& target : targets) {
    const std::shared_ptr<const CatalogueModel> model = catalogue_model(target.model, target.settings);
    const CircuitDesign design = design_of(GetParam());
    const FilterCircuit circuit = filter_circuit(model, target.name, design);
    Simulator simulator(*circuit.machine);
    const auto golden = circuit.machine->golden();
    std::uint64_t seed = 0;
    const auto run = [&](std::uint32_t particles, Step steps, StreamPauses pauses = {}) {
      RunRegisters registers = design.registers;
      registers.particles = registers.draws = particles * design.lanes;
      registers.exchange = std::min(registers.exchange, particles);
      particle_steps += expect_equal(circuit, simulator, *golden, registers,
                                     simulated_scene(*model, steps, ++seed).recording, pauses);
    };
    for (const std::uint32_t particles : {1U, 2U, 3U, 17U, 100U, 1023U, 1024U})
      if (particles * design.lanes <= design.registers.particles) run(particles, 20);
    for (int k = 0; k < 5; ++k) run(1024 / design.lanes, 50);
    run(64, 40, {100, 100, 3});
    run(5, 200, {240, 240, 4});

    constexpr Step kSteps = 12;  // eight lanes are through with five before the last reset
    const auto observed = observed_by(circuit, simulated_scene(*model, kSteps, 9).recording, "test");
    RunRegisters some = design.registers;
    some.particles = some.draws = 64;
    some.exchange = std::min(some.exchange, 64 / design.lanes);
    for (const std::uint64_t cycle : {30U, 150U, 301U}) {
      EXPECT_FALSE(simulator.run(some, observed, {}, cycle).complete);
      simulator.reset();
      const CircuitRun anew = simulator.run(some, observed);
      EXPECT_EQ(agreement(anew, *circuit.machine->golden(), some, observed).mismatches, 0U) << cycle;
      const auto twin = design.architecture->golden(circuit.datapath.arithmetic, 2, circuit.machine->capacity());
      EXPECT_GT(agreement(anew, *twin, some, observed).mismatches, kSteps * 50U) << "the twin";
      simulator.reset();
    }
  }
  EXPECT_GE(particle_steps, 1'000'000U);
}

INSTANTIATE_TEST_SUITE_P(All, SchemesNightly, ::testing::ValuesIn(clouds()),
                         [](const ::testing::TestParamInfo<Cloud>& one) { return one.param.name; });

}  // namespace
}  // namespace mote::hardware

// Circuits of chains from models of the catalogue, clock by clock.

#include <gtest/gtest.h>

#include "mote/app/circuits/circuit.hpp"
#include "mote/hardware/machine/simulator.hpp"
#include "tests/hardware/models.hpp"

namespace mote::hardware {
namespace {

/// A kind of circuit and the model that it is of.
struct Kind {
  std::string name, model;
  std::vector<std::string> settings;
  std::string arch;
  unsigned lanes = 1;
  bool overlapped = false;
  std::string proposal = "prior";
  int interval = 1;
};

const Architecture& architecture_of(const std::string& name) {
  for (const Architecture& one : architectures())
    if (one.name == name) return one;
  throw std::invalid_argument(name);
}

/// Recordings of the model as the circuit takes them, every seventh step unseen.
std::vector<std::vector<std::int64_t>> observed_of(const CatalogueModel& model, const FilterCircuit& circuit,
                                                   Step steps, std::uint64_t seed) {
  std::vector<std::vector<std::int64_t>> observed;
  for (const ObservedStep& step : simulated_scene(model, steps, seed).recording.steps) {
    Row<double> row = step.rows.front();
    if (step.t % 7 == 0)
      for (std::size_t j = 0; j < row.present.size(); ++j)
        if (!circuit.recorded.columns[j].input) row.present[j] = false;
    observed.push_back(circuit.datapath.observe(row, circuit.recorded.schedule(step.t)));
  }
  return observed;
}

class ChainsNightly : public ::testing::TestWithParam<Kind> {};

// claim    the circuit of a model writes its golden model's particles and gives its estimates, with streams that pause
// and
//          without; cycles are the golden model's own when nothing pauses
// design   more than 10^5 particle-steps a kind and 10^6 in all: N = 1000, Q = 1200, N_b = 40, and small runs
// twin     the golden model of another seed
TEST_P(ChainsNightly, EqualTheirGoldenModels) {
  const Kind& kind = GetParam();
  const std::shared_ptr<const CatalogueModel> model = catalogue_model(kind.model, kind.settings);
  CircuitDesign design;
  design.architecture = &architecture_of(kind.arch);
  design.registers = {1000, 1200, 40, false};
  design.lanes = kind.lanes;
  design.variant.overlapped = kind.overlapped;
  design.proposal = kind.proposal;
  design.interval = kind.interval;
  const FilterCircuit circuit = filter_circuit(model, kind.model, design);
  Simulator simulator(*circuit.machine);
  const auto golden = circuit.machine->golden();
  const auto equal = [&](const RunRegisters& registers, Step steps, StreamPauses pauses) {
    const auto observed = observed_of(*model, circuit, steps, registers.particles);
    const Agreement found = agreement(simulator.run(registers, observed, pauses), *golden, registers, observed);
    EXPECT_EQ(found.mismatches, 0U) << registers.particles;
    if (pauses.observations == 0) {
      EXPECT_EQ(found.cycles, found.predicted_cycles) << registers.particles;
    }
  };
  equal({1000, 1200, 40, false}, 60, {});
  equal({1000, 1000, 0, false}, 40, {30, 30, 1});
  equal({kind.lanes, kind.lanes, 0, false}, 20, {});
  equal({40, 44, 8, true}, 20, {});
  equal({96, 96, 0, true}, 20, {200, 200, 3});
  const auto observed = observed_of(*model, circuit, 5, 9);
  EXPECT_FALSE(simulator.run({52, 60, 4, false}, observed, {}, 200).complete);
  simulator.reset();
  const CircuitRun run = simulator.run({52, 60, 4, false}, observed);
  EXPECT_EQ(agreement(run, *circuit.machine->golden(), {52, 60, 4, false}, observed).mismatches, 0U);
  const auto other = design.architecture->golden(circuit.datapath.arithmetic, 99, circuit.machine->capacity());
  EXPECT_GT(agreement(run, *other, {52, 60, 4, false}, observed).mismatches, 100U) << "the twin";
}

INSTANTIATE_TEST_SUITE_P(
    Models, ChainsNightly,
    ::testing::Values(Kind{"growth_overlapped", "ungm", {}, "imh", 1, true},
                      Kind{"growth_pairs", "ungm", {}, "imh-chain", 4},
                      Kind{"growth2_pairs_overlapped", "ungm", {"copies=2"}, "imh-chain", 4, true},
                      Kind{"bearings_pairs", "bearings", {}, "imh-chain", 2},
                      Kind{"bearings_chains_overlapped", "bearings", {}, "imh-parallel", 2, true},
                      Kind{"doa_pairs_overlapped", "doa", {}, "imh-chain", 2, true},
                      Kind{"growth_auxiliary", "ungm", {}, "auxiliary", 1, false, "observation"},
                      Kind{"growth2_auxiliary_overlapped", "ungm", {"copies=2"}, "auxiliary", 1, true, "observation"},
                      Kind{"bearings_auxiliary", "bearings", {}, "auxiliary", 1, false, "prior"},
                      Kind{"doa_auxiliary", "doa", {}, "auxiliary", 1, false, "prior"},
                      Kind{"growth2_in_turn", "ungm", {"copies=2"}, "imh", 1, false, "prior", 2},
                      Kind{"bearings_in_turn", "bearings", {}, "imh-parallel", 2, false, "prior", 4},
                      Kind{"doa_in_turn", "doa", {}, "imh", 1, false, "prior", 4},
                      Kind{"growth_auxiliary_in_turn", "ungm", {}, "auxiliary", 1, false, "observation", 3}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace mote::hardware

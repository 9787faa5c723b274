#include "mote/hardware/machine/simulator.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/machine/bits.hpp"
#include "mote/hardware/machine/local_level.hpp"
#include "mote/hardware/machine/templates.hpp"
#include "mote/hardware/synthesis.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

const RunRegisters kMost{256, 400, 40, false, 5};  // as many particles as the memories hold

/// An architecture, built one way or another.
struct Kind {
  const Architecture* architecture;
  Variant variant = {};

  unsigned lanes(unsigned most) const { return std::min(most, architecture->most_lanes); }
  Machine machine(std::uint64_t seed, unsigned lanes) const {
    Variant built = variant;
    built.overlapped = architecture->folded;  // one kind overlapped
    return {local_level_circuit(), *architecture, kMost, seed, lanes, built};
  }
};

/// claim   circuit and golden model write the same particles and give the same estimates, with streams that pause and
///         without, and after a reset in mid-run; cycles are the golden model's own when nothing pauses
/// twin    the golden model of another seed, of which every step differs
class Machines : public ::testing::TestWithParam<Kind> {};

std::vector<Kind> all_architectures() {
  std::vector<Kind> all;
  for (const Architecture& one : architectures()) all.push_back({&one});
  return all;
}

std::string shown(const ::testing::TestParamInfo<Kind>& info) {
  std::string name(info.param.architecture->name);
  std::replace(name.begin(), name.end(), '-', '_');
  const Variant& variant = info.param.variant;
  if (variant.resampler == Resampler::kResidualSystematic) name += "_residual";
  if (variant.resampler == Resampler::kRoulette) name += "_roulette";
  if (variant.loops.merged) return name + "_merged";
  return variant.loops.pipelined ? name + "_pipelined" : name;
}

TEST_P(Machines, EqualTheirGoldenModels) {
  const unsigned lanes = GetParam().lanes(4);
  const Machine machine = GetParam().machine(7, lanes);
  Simulator circuit(machine);
  const auto golden = machine.golden();
  const auto equal = [&](const RunRegisters& registers, StreamPauses pauses) {
    const auto observed = level_observations(20, registers.particles);
    const CircuitRun run = circuit.run(registers, observed, pauses);
    const Agreement found = agreement(run, *golden, registers, observed);
    EXPECT_TRUE(run.complete);
    EXPECT_EQ(found.mismatches, 0U) << registers.particles;
    EXPECT_EQ(found.compared, 20U * registers.particles);
    if (pauses.observations == 0) {
      EXPECT_EQ(found.cycles, found.predicted_cycles) << registers.particles;
    }
  };
  equal(kMost, {});
  equal({lanes, lanes, 0, false, 1}, {});
  equal({148, 300, 10, false, 0}, {40, 40, 3});
  equal({92, 92, 0, true, 23}, {220, 220, 5});

  const auto observed = level_observations(5, 9);
  EXPECT_FALSE(circuit.run({52, 60, 5, false}, observed, {}, 150).complete);
  circuit.reset();
  const CircuitRun run = circuit.run({52, 60, 5, false}, observed);
  EXPECT_EQ(agreement(run, *machine.golden(), {52, 60, 5, false}, observed).mismatches, 0U);
  EXPECT_GE(agreement(run, *GetParam().architecture->golden(machine.model().arithmetic, 8, machine.capacity()),
                      {52, 60, 5, false}, observed)
                .mismatches,
            5U * 45)
      << "the twin";
}

/// claim   registers written and read over AXI4-Lite, whose both sides pause, start the same run; addresses outside the
///         map and a start in mid-run are answered by errors and change nothing
/// twin    the golden model of another N
TEST(Machine, IsReachedOverABus) {
  const Machine machine(local_level_circuit(), architectures().front(), kMost, 7, 1, {}, RegisterAccess::kAxiLite);
  Simulator circuit(machine);
  const auto golden = machine.golden();
  for (const unsigned pause : {0U, 120U}) {
    const RunRegisters registers{60 + pause, 80 + pause, 5, false};
    const auto observed = level_observations(6, pause);
    const CircuitRun run = circuit.run(registers, observed, {pause, pause, 3});
    EXPECT_FALSE(run.answered_wrong);
    const Agreement found = agreement(run, *golden, registers, observed);
    EXPECT_EQ(found.mismatches, 0U) << pause;
    if (pause == 0) {
      EXPECT_EQ(found.cycles, found.predicted_cycles);
    }
    EXPECT_NE(agreement(run, *machine.golden(), {60 + pause, 81 + pause, 5, false}, observed).mismatches, 0U);
  }
}

TEST_P(Machines, NameWhatTheyNeedAndNoMore) {
  const Machine machine = GetParam().machine(1, 1);
  std::string names;
  for (const DesignFile& file : machine.modules("")) names += file.name + " ";
  for (const char* needed : {"mote_estimate.sv", "mote_piecewise.sv", "mote_words.sv", "local_level_weigh.sv"})
    EXPECT_NE(names.find(needed), std::string::npos) << needed;
  EXPECT_EQ(names.find("mote_cordic.sv"), std::string::npos);
  EXPECT_TRUE(names.ends_with(machine.name() + ".sv "));
  const std::string top = machine.top("");
  EXPECT_EQ(top.find('@'), std::string::npos);
  EXPECT_NE(top.find("s12.5   level"), std::string::npos) << top;
}

// Debian's Yosys has no grammar for packed arrays of several dimensions, casts to named types, `return` in functions.
TEST_P(Machines, AreReadByYosys) {
  const Machine machine = GetParam().machine(1, GetParam().lanes(2));
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  for (const DesignFile& file : machine.modules(folder)) write_text(folder + file.name, file.text);
  for (const DesignFile& file : machine.tables()) write_text(folder + file.name, file.text);
  const auto cells = cells_after(folder, "hierarchy -check -top " + machine.name() + "; proc; flatten");
  EXPECT_GT(total(cells, {"$mul", "$add", "$dff", "$adff"}), 20);
}

INSTANTIATE_TEST_SUITE_P(All, Machines, ::testing::ValuesIn(all_architectures()), shown);

// The schemes beside systematic resampling; nightly tests have them in every architecture.
std::vector<Kind> schemes() {
  const auto sisr = std::find_if(architectures().begin(), architectures().end(),
                                 [](const Architecture& one) { return one.name == "sisr"; });
  return {{&*sisr, {Resampler::kResidualSystematic, {}}}, {&*sisr, {Resampler::kRoulette, {}}}};
}
INSTANTIATE_TEST_SUITE_P(Schemes, Machines, ::testing::ValuesIn(schemes()), shown);

TEST(Machine, RefusesMoreParticlesThanItsSumsHold) {
  EXPECT_THROW(Machine(local_level_circuit(), architectures().front(), {1U << 22, 1U << 22, 0, false}), Refusal);
}

TEST(Bits, ComeBackAsTheyWent) {
  BitWriter writer(100);
  writer.append(-3, 18);
  writer.append(0x123456789ABCDE, 60);
  writer.append(5, 20);
  BitReader reader(writer.words().data());
  EXPECT_EQ(reader.take_signed(18), -3);
  EXPECT_EQ(reader.take(60), 0x123456789ABCDEU);
  EXPECT_EQ(reader.take(20), 5U);
}

}  // namespace
}  // namespace mote::hardware

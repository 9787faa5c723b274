#include "mote/hardware/lowering.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "mote/hardware/machine/local_level.hpp"
#include "mote/hardware/machine/simulator.hpp"

namespace mote::hardware {
namespace {

TEST(Lowered, HasNoTypesReturnsOrArrays) {
  EXPECT_EQ(lowered("typedef logic signed [W-1:0] t;\nt a_q;\nassign a_q = t'(b + (c));"),
            "\nlogic signed [W-1:0] a_q;\nassign a_q = $signed(((W-1)+1)'(b + (c)));");
  EXPECT_EQ(lowered("function automatic logic f(input logic x); return x; endfunction"),
            "function automatic logic f(input logic x); f = x; endfunction");
  EXPECT_EQ(lowered("logic [N-1:0][7:0] m;\nassign y = m[i] ^ m[i+1][3] ^ m[2][5:4];"),
            "logic [((N-1)+1)*((7)+1)-1:0] m;\nassign y = m[0+(i)*((7)+1) +: ((7)+1)] ^ "
            "m[0+(i+1)*((7)+1)+(3)] ^ m[0+(2)*((7)+1)+(4) +: (5)-(4)+1];");
  EXPECT_EQ(lowered("typedef logic [7:0] t;\nt [N-1:0] m;\nassign y = m[i][7-:4];"),
            "\nlogic [((N-1)+1)*((7)+1)-1:0] m;\nassign y = m[0+(i)*((7)+1)+(7) -: 4];");
  EXPECT_EQ(lowered("logic [7:0] v, memory[4];\nassign y = v[3] ^ memory[2];"),
            "logic [7:0] v, memory[4];\nassign y = v[3] ^ memory[2];");
  EXPECT_THROW(lowered("logic [3:0][7:0] m;\nassign y = m[2:1];"), std::logic_error);
}

/// claim   lowered modules compute what they computed
/// design  every kind of filter, simulated from lowered modules against its golden model
TEST(Lowered, ComputesTheSame) {
  for (const Architecture& architecture : architectures()) {
    const RunRegisters registers{60, 72, 5, false};
    const Machine machine(local_level_circuit(), architecture, registers, 1, std::min(4U, architecture.most_lanes));
    Simulator circuit(machine, Simulator::Text::kLowered);
    const auto observed = level_observations(10, 4);
    const Agreement found = agreement(circuit.run(registers, observed), *machine.golden(), registers, observed);
    EXPECT_EQ(found.compared, 600U);
    EXPECT_EQ(found.mismatches, 0U) << architecture.name;
    EXPECT_EQ(found.cycles, found.predicted_cycles);
  }
}

}  // namespace
}  // namespace mote::hardware

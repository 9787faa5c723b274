#include "mote/hardware/synthesis.hpp"

#include <gtest/gtest.h>

#include "mote/hardware/arithmetic.hpp"
#include "mote/hardware/choice.hpp"
#include "mote/hardware/machine/cost.hpp"
#include "mote/hardware/random.hpp"
#include "mote/hardware/sketch.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {
namespace {

// referee  by hand: a register of 18 bits behind 18 multiplexers
TEST(Area, CountsWhatASelectionNeeds) {
  const Area area = xc7_area(Select{{true, 7, 10}}.circuit());
  EXPECT_EQ(area.lut, 18);
  EXPECT_EQ(area.ff, 18);
  EXPECT_EQ(area.dsp + area.bram18, 0);
}

TEST(Area, AProductIsOneBlockOrLogic) {
  const Product product{{true, 7, 17}, {true, 7, 10}, {true, 7, 10}};
  Product logic = product;
  logic.multiplier = Multiplier::kLogic;
  EXPECT_EQ(xc7_area(product.circuit()).dsp, 1);
  const Area made = xc7_area(logic.circuit());
  EXPECT_EQ(made.dsp, 0);
  EXPECT_GT(made.lut, 200);
}

// claim    where two parts meet, the beginning and the end of a path are as long as the path in one circuit
// referee  a sum behind a selection's register, in one
TEST(PartCost, PathsGoOnFromPartToPart) {
  const Format word{true, 7, 10};
  Sketch sketch("chosen_sum", Multiplier::kDsp);
  const Signal a = sketch.input("a_i", word);
  const Signal b = sketch.input("b_i", word);
  sketch.output("y_o", sketch.sum(sketch.select(sketch.input("s_i", {false, 1, 0}), a, b), a, word));
  const PartCost whole = part_cost(sketch.done().circuit());
  const PartCost choice = part_cost(Select{word}.circuit());
  const PartCost sum = part_cost(Sum{word, word, word}.circuit());
  EXPECT_EQ(choice.path_ns, 0);  // no register before it
  EXPECT_GT(whole.path_ns, 0.5);
  EXPECT_NEAR(choice.leaving_ns + sum.coming_ns, whole.path_ns, 0.05 * whole.path_ns);
}

TEST(Routed, AUniformSourceIsFasterThanAWideSum) {
  const Routed uniform = ice40_routed(WordSource{}.circuit());
  const Routed sum = ice40_routed(Sum{{true, 30, 30}, {true, 30, 30}, {true, 30, 30}}.circuit());
  EXPECT_GT(uniform.mhz, 150);
  EXPECT_GT(uniform.mhz, 1.5 * sum.mhz);
}

}  // namespace
}  // namespace mote::hardware

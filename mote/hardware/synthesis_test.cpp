#include "mote/hardware/synthesis.hpp"

#include <gtest/gtest.h>

#include "mote/hardware/arithmetic.hpp"
#include "mote/hardware/choice.hpp"
#include "mote/hardware/machine/cost.hpp"
#include "mote/hardware/random.hpp"
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

// claim    a machine with the anchor's pipelines takes what the anchor takes; others count once a lane, and one that is
//          slower than all of the anchor rules the clock
// referee  by hand; half of a clock's time goes to cells
TEST(CostOfParts, PutsPipelinesInPlaceOfTheAnchors) {
  const PartCost anchor{{1000, 800, 9, 7}, 4};
  const PipelineCosts old{{{100, 90, 2, 1}, 3}, {{50, 40, 1, 0}, 2}};
  const Cost same = cost_of_parts(anchor, 4, old, old);
  EXPECT_EQ(same.lut, 1000);
  EXPECT_EQ(same.ff, 800);
  EXPECT_EQ(same.dsp, 9);
  EXPECT_EQ(same.bram18, 7);
  EXPECT_DOUBLE_EQ(*same.fmax_mhz, 125);
  EXPECT_DOUBLE_EQ(*same.power_mw, power_mw(anchor.area, 125));
  const Cost wider = cost_of_parts(anchor, 4, old, {{{110, 95, 3, 2}, 3.5}, {{52, 40, 1, 0}, 5}});
  EXPECT_EQ(wider.lut, 1000 + 4 * (10 + 2));
  EXPECT_EQ(wider.ff, 800 + 4 * 5);
  EXPECT_EQ(wider.dsp, 9 + 4);
  EXPECT_EQ(wider.bram18, 7 + 4);
  EXPECT_DOUBLE_EQ(*wider.fmax_mhz, 100);
}

TEST(Routed, AUniformSourceIsFasterThanAWideSum) {
  const Routed uniform = ice40_routed(WordSource{}.circuit());
  const Routed sum = ice40_routed(Sum{{true, 30, 30}, {true, 30, 30}, {true, 30, 30}}.circuit());
  EXPECT_GT(uniform.mhz, 150);
  EXPECT_GT(uniform.mhz, 1.5 * sum.mhz);
}

}  // namespace
}  // namespace mote::hardware

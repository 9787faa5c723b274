#include "mote/hardware/choice.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "mote/hardware/bench_laws.hpp"
#include "mote/hardware/cordic.hpp"
#include "mote/hardware/shift.hpp"

namespace mote::hardware {
namespace {

TEST(Choice, ComparesAcrossFormats) {
  const Less less{{true, 2, 1}, {false, 3, 3}};
  for (Word a = -8; a < 8; ++a)
    for (Word b = 0; b < 64; ++b) EXPECT_EQ(less(a, b), less.a.value(a) < less.b.value(b));
}

TEST(Choice, TakesBitsOutOfAWord) {
  const Convert middle = bits_of({true, 3, 4}, 2, 4, 1);
  EXPECT_EQ(middle.y.name(), "u3.1");
  for (Word a = -128; a < 128; ++a) EXPECT_EQ(middle(a), (a >> 2) & 15);
}

// referee  the definition: bit by bit
TEST(Normalise, PutsTheLeadingOneAtTheTop) {
  for (const bool even : {false, true})
    for (Word x = 0; x < 4096; ++x) {
      const Normalise normalise{12, even};
      const int s = normalise.shift(x);
      EXPECT_LT(x << s, 4096);
      if (x == 0) continue;
      EXPECT_GE(x << s, even ? 1024 : 2048);
      EXPECT_TRUE(!even || s % 2 == 0);
    }
}

TEST(Choice, CircuitsEqualTheirTwins) {
  Lockstep all;
  all.add(Less{{true, 7, 10}, {true, 5, 12}});
  all.add(Less{{false, 7, 3}, {true, 9, -1}});
  all.add(Select{{true, 7, 10}});
  all.add(Select{{true, 7, 10}, false});
  for (const bool greater : {false, true}) {
    all.add(Extremum{{true, 7, 10}, greater});
    all.add(Extremum{{false, 7, 10}, greater});
  }
  all.add(NegateIf{{true, 7, 10}, {true, 7, 10}});
  all.add(NegateIf{{false, 7, 10}, {true, 6, 10}});
  all.add(NegateIf{{true, 7, 10}, {false, 8, 10}});
  all.add(Convert{{false, 7, 10}, {true, 4, 3}});
  all.add(bits_of({true, 7, 10}, 3, 9, 4));
  for (const int width : {2, 7, 18, 33}) all.add(Normalise{width});
  for (const int width : {2, 18, 40}) all.add(Normalise{width, true});
  all.add(Scale{{false, 1, 17}, 5, {false, 6, 12}});
  all.add(Scale{{false, 1, 24}, 4, {false, 3, 8}});
  all.add(Scale{{false, 9, 3}, 6, {false, 10, 20}});
  for (const auto mode : {Cordic::Mode::kCircular, Cordic::Mode::kLinear, Cordic::Mode::kHyperbolic})
    for (const bool vectoring : {false, true}) all.add(Cordic(mode, vectoring, 14, 20, {true, 2, 16}));
  all.expect_agreement(1'000'000);
}

}  // namespace
}  // namespace mote::hardware

#include "mote/hardware/arithmetic.hpp"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "mote/hardware/bench_laws.hpp"

namespace mote::hardware {
namespace {

constexpr Finish kAllFinishes[] = {{Rounding::kDown, Overflow::kWrap},
                                   {Rounding::kDown, Overflow::kSaturate},
                                   {Rounding::kNearest, Overflow::kWrap},
                                   {Rounding::kNearest, Overflow::kSaturate}};

TEST(SignedDigits, AreTheNumberAndNoTwoAreNeighbours) {
  for (Word number = -5000; number <= 5000; ++number) {
    const SignedDigits digits = signed_digits(number);
    EXPECT_EQ(static_cast<Word>(digits.plus) - static_cast<Word>(digits.minus), number);
    const std::uint64_t all = digits.plus | digits.minus;
    EXPECT_EQ(digits.plus & digits.minus, 0U);
    EXPECT_EQ(all & (all >> 1U), 0U);
  }
}

TEST(ConstantWord, KeepsItsSignificantBits) {
  for (const double value : {3.141592653589793, -0.001, 1e6}) {
    const auto [word, fraction] = constant_word(value, 18);
    EXPECT_NEAR(std::ldexp(static_cast<double>(word), -fraction) / value, 1.0, 0x1p-18);
    EXPECT_LE(std::bit_width(static_cast<std::uint64_t>(std::abs(word))), 19);
  }
}

// referee  the same in double, exact for these widths
TEST(Arithmetic, IsWithinHalfAStep) {
  const Format a{true, 4, 7};
  const Format b{false, 3, 9};
  const Format y{true, 9, 6};
  const Sum sum{a, b, y};
  const Sum difference{a, b, y, true};
  const Product product{a, b, y};
  for (Word left = a.least(); left <= a.greatest(); ++left)
    for (Word right = b.least(); right <= b.greatest(); right += 3) {
      const double u = a.value(left);
      const double v = b.value(right);
      ASSERT_LE(std::abs(y.value(sum(left, right)) - (u + v)), y.step() / 2);
      ASSERT_LE(std::abs(y.value(difference(left, right)) - (u - v)), y.step() / 2);
      ASSERT_LE(std::abs(y.value(product(left, right)) - u * v), y.step() / 2);
    }
}

TEST(Arithmetic, CircuitsEqualTheirTwins) {
  Lockstep all;
  for (const Finish& finish : kAllFinishes) {
    all.add(Sum{{true, 7, 10}, {true, 5, 12}, {true, 6, 9}, false, finish});
    all.add(Sum{{true, 7, 10}, {false, 8, 4}, {false, 7, 8}, true, finish});
    all.add(Sum{{false, 4, 3}, {false, 9, -2}, {true, 9, 5}, true, finish});
    all.add(Product{{true, 7, 10}, {true, 3, 14}, {true, 9, 8}, Multiplier::kDsp, finish});
    all.add(Product{{true, 9, 15}, {false, 0, 17}, {true, 8, 16}, Multiplier::kDsp, finish});
    all.add(Product{{false, 9, 9}, {true, 4, 12}, {true, 8, 9}, Multiplier::kLogic, finish});
    all.add(Product{{true, 3, 9}, {false, 2, 9}, {true, 6, 30}, Multiplier::kLogic, finish});
    for (const Word constant : {1, -1, 85, -341, 20860, 102944})
      all.add(ConstantProduct{{true, 5, 12}, {true, 8, 10}, constant, 9, finish});
    all.add(ConstantProduct{{false, 5, 8}, {true, 8, 6}, -205887, 16, finish});
  }
  all.add(Product{{true, 0, 31}, {true, 0, 31}, {true, 0, 40}});
  all.expect_agreement(1'000'000);
}

}  // namespace
}  // namespace mote::hardware

#include "mote/graph/fixed.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mote/graph/evaluate.hpp"

namespace mote::graph {
namespace {

constexpr Format kSmall{true, 2, 3};  // [-4, 3.875] in steps of 1/8

TEST(Format, SaysWhatItHolds) {
  EXPECT_EQ(kSmall.width(), 6);
  EXPECT_EQ(kSmall.value(kSmall.least()), -4);
  EXPECT_EQ(kSmall.value(kSmall.greatest()), 3.875);
  EXPECT_EQ(kSmall.name(), "s2.3");
  EXPECT_EQ((Format{false, 0, 8}.name()), "u0.8");
}

TEST(Format, RoundsAndSaturates) {
  const auto fixed = [](double value, Rounding rounding) { return kSmall.value(to_fixed(value, kSmall, rounding)); };
  EXPECT_EQ(fixed(1.0625, Rounding::kNearest), 1.125) << "halves upwards";
  EXPECT_EQ(fixed(-1.0625, Rounding::kNearest), -1);
  EXPECT_EQ(fixed(1.0625, Rounding::kTruncate), 1);
  EXPECT_EQ(fixed(-1.0625, Rounding::kTruncate), -1.125);
  EXPECT_EQ(fixed(3.9, Rounding::kNearest), 3.875);
  EXPECT_EQ(fixed(kInfinity, Rounding::kNearest), 3.875);
  EXPECT_EQ(fixed(-1e300, Rounding::kTruncate), -4);
  EXPECT_EQ(fixed(kNaN, Rounding::kNearest), 0);
}

TEST(Format, RescalesLikeTheDouble) {
  for (const int fraction : {-2, 0, 3, 5, 40})
    for (std::int64_t raw = -300; raw <= 300; ++raw)
      for (const Rounding rounding : {Rounding::kNearest, Rounding::kTruncate})
        ASSERT_EQ(rescaled(raw, fraction, kSmall, rounding),
                  to_fixed(std::ldexp(static_cast<double>(raw), -fraction), kSmall, rounding));
  EXPECT_EQ(rescaled(static_cast<Wide>(1) << 100, -40, kSmall, Rounding::kNearest), kSmall.greatest());
}

TEST(Format, IsTheSmallestThatHoldsAnInterval) {
  EXPECT_EQ(format_for({-4, 3.5}, 3), kSmall);
  EXPECT_EQ(format_for({-4, 4}, 3).integer, 3);
  EXPECT_EQ(format_for({0, 0.2}, 8), (Format{false, -2, 8}));
  EXPECT_EQ(format_for({-kInfinity, kInfinity}, 10, 30).width(), 30);
  EXPECT_EQ(format_for({0, 0}, 10).width(), 1);
  EXPECT_EQ(format_for({-3e5, 1e6}, 24, 40), (Format{true, 20, 19})) << "bits before the point come first";
}

// claim    the integer twins round the exact result once
// referee  double, in which these operands' results are exact or far from a tie
// design   all operands of two formats of five and six bits, every operation, both roundings: exhaustive
TEST(Twins, RoundTheExactResult) {
  const Format a_format{true, 1, 3};
  const Format out{true, 3, 2};
  for (std::size_t number = 2; number < rounded_double_twins().by_op.size(); ++number) {
    const Op op = static_cast<Op>(number);
    for (const Rounding rounding : {Rounding::kNearest, Rounding::kTruncate}) {
      const FixedOperation operation{op, out, {a_format, kSmall, a_format, kSmall}, rounding};
      for (std::int64_t a = a_format.least(); a <= a_format.greatest(); ++a)
        for (std::int64_t b = kSmall.least(); b <= kSmall.greatest(); ++b) {
          const double x = a_format.value(a);
          const double y = kSmall.value(b);
          const auto exact = apply<double>(op, {x, y, x, y});
          ASSERT_EQ(rounded_double_twins().by_op[number](operation, {a, b, a, b}), to_fixed(exact, out, rounding))
              << name_of(op) << " of " << x << ", " << y;
        }
    }
  }
}

TEST(Twins, MultiplyWithoutLosingBits) {
  // 2^60 + 1 squared has no exact double
  const Format wide{true, 61, 0};
  const FixedOperation operation{Op::kMultiply, {true, 61, 0}, {wide, {true, 0, 61}}, Rounding::kTruncate};
  const std::int64_t a = (std::int64_t{1} << 60) + 1;
  EXPECT_EQ(rounded_double_twins().by_op[static_cast<std::size_t>(Op::kMultiply)](operation, {a, a, 0, 0}),
            (std::int64_t{1} << 59) + 1);
}

}  // namespace
}  // namespace mote::graph

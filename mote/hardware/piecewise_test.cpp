#include "mote/hardware/piecewise.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/hardware/bench_laws.hpp"

namespace mote::hardware {
namespace {

struct Case {
  const char* name;
  std::function<double(double)> function;
  Format x, y;
  Fold fold;
  int centre = 0;
  FitGoal goal = {};
};

double drift(double x) { return x / 2 + 25 * x / (1 + x * x); }

std::vector<Case> cases() {
  return {{"drift", drift, {true, 7, 10}, {true, 7, 10}, Fold::kOdd},
          {"drift by lines", drift, {true, 7, 10}, {true, 7, 10}, Fold::kOdd, 0, {1.5, 1}},
          {"drift by logic", drift, {true, 6, 10}, {true, 7, 8}, Fold::kOdd, 0, {1.0, 2, Multiplier::kLogic}},
          {"exp on both sides", [](double x) { return std::exp(x); }, {true, 2, 12}, {false, 5, 10}, Fold::kSides},
          {"bell",
           [](double x) { return std::exp(-(x - 1.5) * (x - 1.5)); },
           {true, 3, 11},
           {false, 1, 12},
           Fold::kEven,
           3072},
          {"cosine", [](double x) { return std::cos(x); }, {true, 2, 14}, {true, 1, 14}, Fold::kPlain},
          {"square root", [](double x) { return std::sqrt(x); }, {false, 6, 12}, {false, 3, 12}, Fold::kPlain},
          {"reciprocal, saturating", [](double x) { return 1 / x; }, {false, 4, 12}, {false, 4, 10}, Fold::kPlain},
          {"narrow", [](double x) { return 3 * x; }, {true, 1, 2}, {true, 4, 3}, Fold::kOdd}};
}

Piecewise fitted(const Case& one) { return fit_piecewise(one.function, one.x, one.y, one.fold, one.centre, one.goal); }

// claim    a unit keeps to its goal on every number of x's format, not only on those that the fit looked at
// referee  the function in double
TEST(Piecewise, KeepsToItsGoalEverywhere) {
  for (const Case& one : cases()) {
    const Piecewise unit = fitted(one);
    double worst = 0;
    for (Word x = one.x.least(); x <= one.x.greatest(); ++x) {
      if (one.fold != Fold::kPlain && x == one.x.least() && one.centre == 0) continue;  // taken for its neighbour
      const double want =
          std::clamp(one.function(one.x.value(x)), one.y.value(one.y.least()), one.y.value(one.y.greatest()));
      worst = std::max(worst, std::abs(one.y.value(unit(x)) - want) / one.y.step());
    }
    EXPECT_LE(worst, one.goal.steps) << one.name;
    EXPECT_GT(worst, 0.2 * one.goal.steps) << one.name << ": finer than asked, so larger than needed";
    RecordProperty(one.name, std::to_string(unit.shape().entries()) + " segments, " +
                                 std::to_string(unit.memory_bits()) + " bits");
  }
}

TEST(Piecewise, TheStatedErrorIsTheMeasuredOne) {
  const Case one = cases().front();
  const Piecewise unit = fitted(one);
  double worst = 0;
  for (Word x = one.x.least() + 1; x <= one.x.greatest(); ++x)
    worst = std::max(worst, std::abs(static_cast<double>(unit(x)) - one.function(one.x.value(x)) / one.y.step()));
  EXPECT_DOUBLE_EQ(worst_error(unit, one.function, 1U << 20U), worst);
}

TEST(Piecewise, AGoalOutOfReachIsRefused) {
  EXPECT_THROW(fit_piecewise(drift, {true, 7, 10}, {true, 7, 10}, Fold::kOdd, 0, {0.3, 2}), Refusal);
}

// claim    a search that finds nothing is short: what one shape misses the next ones are asked first
// design   a pole within x's range; asked from end to end the shapes read 552 564 numbers
TEST(Piecewise, ASearchThatFindsNothingIsShort) {
  std::size_t calls = 0;
  const auto pole = [&](double x) {
    ++calls;
    return 0.01 / (x * x * x - 0.3) + 0.9 * x;
  };
  const FitGoal goal{1.0, 2, Multiplier::kDsp, 1024};
  EXPECT_THROW(fit_piecewise(pole, {true, 2, 14}, {true, 2, 14}, Fold::kSides, 0, goal), Refusal);
  EXPECT_LT(calls, 20'000U);
}

TEST(Piecewise, CircuitsEqualTheirTwins) {
  Lockstep all;
  for (const Case& one : cases()) all.add(fitted(one));
  all.expect_agreement(1'000'000);
}

}  // namespace
}  // namespace mote::hardware

#include "mote/hardware/lookup.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/hardware/bench_laws.hpp"

namespace mote::hardware {
namespace {

struct Case {
  const char* name;
  std::function<double(double)> function;
  Format x, y;
};

std::vector<Case> cases() {
  return {{"drift, in a block of memory",
           [](double x) { return x / 2 + 25 * x / (1 + x * x); },
           {true, 6, 4},
           {true, 6, 4}},
          {"square, saturating", [](double x) { return x * x; }, {true, 3, 3}, {false, 5, 4}},
          {"reciprocal, infinite at 0", [](double x) { return 1 / x; }, {false, 2, 4}, {false, 3, 5}},
          {"one bit", [](double x) { return 3 - x; }, {false, 1, 0}, {true, 2, 1}}};
}

/// The greatest error over all numbers, in steps of y, where y saturates.
double worst_error(const Lookup& table, const Case& one) {
  double worst = 0;
  for (Word x = one.x.least(); x <= one.x.greatest(); ++x) {
    const double want =
        std::clamp(one.function(one.x.value(x)), one.y.value(one.y.least()), one.y.value(one.y.greatest()));
    worst = std::max(worst, std::abs(one.y.value(table(x)) - want) / one.y.step());
  }
  return worst;
}

// claim    every entry is rounded correctly
// referee  the function in double; the twin (a table that is off by a hundredth of a step more) must be caught
TEST(Lookup, IsWithinHalfAStepEverywhere) {
  for (const Case& one : cases()) EXPECT_LE(worst_error(Lookup(one.function, one.x, one.y), one), 0.5) << one.name;
  const Case drift = cases().front();
  const auto off = [&](double x) { return drift.function(x) + 0.01 * drift.y.step(); };
  EXPECT_GT(worst_error(Lookup(off, drift.x, drift.y), drift), 0.5);
}

TEST(Lookup, CircuitsEqualTheirTwins) {
  Lockstep all;
  for (const Case& one : cases()) all.add(Lookup(one.function, one.x, one.y));
  all.add(Lookup(cases().front().function, cases().front().x, cases().front().y).in_logic());
  all.add(LookupPair{Lookup(cases().front().function, cases().front().x, cases().front().y)});
  all.expect_agreement(100'000);
}

}  // namespace
}  // namespace mote::hardware

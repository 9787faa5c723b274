#include "mote/engine/budget.hpp"

#include <gtest/gtest.h>

#include "mote/filter/sisr.hpp"
#include "mote/model/local_level.hpp"

namespace mote {
namespace {

/// Steps of 1 us and 10 ns a particle.
double linear(std::size_t n) { return 1e-6 + 1e-8 * static_cast<double>(n); }

// claim    what is found keeps within the budget and spends most of it
// referee  a clock whose times are known: 1 us + 10 ns N
TEST(Affordable, SpendsTheBudget) {
  for (const double budget : {3e-6, 2e-5, 1e-3, 0.1}) {
    const Affordable found = affordable(budget, 64, 1U << 28U, linear);
    EXPECT_TRUE(found.fits);
    EXPECT_LE(found.step_seconds, budget);
    EXPECT_GE(found.step_seconds, 0.8 * budget);
    EXPECT_DOUBLE_EQ(found.step_seconds, linear(found.particles));
    EXPECT_EQ(found.particles % 64, 0U);
  }
}

TEST(Affordable, KeepsItsBounds) {
  EXPECT_EQ(affordable(1, 64, 5000, linear).particles, 5000U);
  const Affordable least = affordable(1e-9, 100, 5000, linear);
  EXPECT_EQ(least.particles, 100U);
  EXPECT_FALSE(least.fits);
  EXPECT_TRUE(affordable(2.1e-6, 100, 5000, linear).fits);
}

// claim    a clock that errs, as clocks do, does not lead astray: few trials, a number that was within when tried
TEST(Affordable, BearsAClockThatErrs) {
  int trials = 0;
  const auto noisy = [&](std::size_t n) { return linear(n) * (++trials % 3 == 0 ? 1.4 : 1.0); };
  const Affordable found = affordable(1e-3, 64, 1U << 28U, noisy);
  EXPECT_LE(found.step_seconds, 1e-3);
  EXPECT_GT(found.particles, 20000U);
  EXPECT_LE(trials, 9);
}

TEST(PilotClock, TimesTheStepsOfNewFilters) {
  const LocalLevel model;
  Recording recording;
  for (Step t = 1; t <= 3; ++t) recording.steps.push_back({t, {Row<double>::of({1000})}});
  recording.steps[1].rows.clear();
  int made = 0;
  const PilotClock clock(
      [&](std::size_t n) {
        ++made;
        return make_sisr(model, n, 1);
      },
      recording, model.states(), 7);
  EXPECT_GT(clock(100), 0);
  EXPECT_EQ(made, 3) << "seven steps are three runs of three";
}

}  // namespace
}  // namespace mote

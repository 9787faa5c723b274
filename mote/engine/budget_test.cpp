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
  EXPECT_LE(trials, 8);
}

// claim    the least number is tried once, and no number a ninth time
TEST(Affordable, TriesTheLeastOnce) {
  int trials = 0;
  int of_least = 0;
  const auto slow = [&](std::size_t n) {
    ++trials;
    if (n == 64) ++of_least;
    return 1.0;
  };
  EXPECT_FALSE(affordable(1e-3, 64, 1U << 28U, slow).fits);
  EXPECT_EQ(of_least, 1);
  const auto slower_each_time = [&](std::size_t) { return 1.01e-3 * ++trials; };
  trials = 0;
  EXPECT_EQ(affordable(1e-3, 64, 1U << 28U, slower_each_time).particles, 64U);
  EXPECT_LE(trials, 8);
}

/// Three steps, the second of which is not observed.
Recording three_steps() {
  Recording recording;
  for (Step t = 1; t <= 3; ++t) recording.steps.push_back({t, {Row<double>::of({1000})}});
  recording.steps[1].rows.clear();
  return recording;
}

TEST(PilotClock, TimesTheStepsOfNewFilters) {
  const LocalLevel model;
  const Recording recording = three_steps();
  RunRequest request;
  request.states = model.states();
  std::size_t reported = 0;
  request.progress = [&](std::size_t, std::size_t) { ++reported; };
  int made = 0;
  const PilotClock clock(
      [&](const Plan& plan) {
        ++made;
        return make_sisr(model, plan.particles, 1);
      },
      recording, {}, request, 7);
  EXPECT_GT(clock(100), 0);
  EXPECT_EQ(made, 3) << "seven steps are three runs of three";
  EXPECT_EQ(reported, 0U) << "the progress is the run's own";
}

TEST(PilotClock, StopsWhenTold) {
  const LocalLevel model;
  const Recording recording = three_steps();
  const std::atomic<bool> stop = true;
  RunRequest request;
  request.stop = &stop;
  const PilotClock clock([&](const Plan& plan) { return make_sisr(model, plan.particles, 1); }, recording, {}, request,
                         1'000'000'000);
  EXPECT_EQ(clock(100), kInfinity);
}

}  // namespace
}  // namespace mote

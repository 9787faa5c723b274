#include "mote/design/integers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace mote::design {
namespace {

Demand random_demand(std::mt19937& random, std::size_t most) {
  std::uniform_real_distribution<double> decades(-3, 3);
  std::uniform_int_distribution<std::size_t> counts(1, most);
  Demand d;
  d.times = {std::pow(10, decades(random)), std::pow(10, decades(random)), std::pow(10, decades(random))};
  d.kept = counts(random);
  d.burn_in = counts(random) / 8;
  d.weights = {1 + std::pow(10, decades(random)), 1, 0.5};
  return d;
}

/// A limit between what one block of each takes and what the quickest takes.
double some_deadline(const Demand& d, double share) {
  const double slow = makespan(line_of(d, 1, 1, 1));
  const std::size_t n = line_of(d, 1, 1, 1).n;
  const double quick = makespan(line_of(d, n, n, 1));
  return quick + share * (slow - quick);
}

/// The best by trying everything with the schedule, played event by event where `plays`.
std::array<double, 3> brute_force(const Demand& d, bool plays) {
  constexpr double kWorst = std::numeric_limits<double>::max();  // infinity would be near every number, relatively
  std::array<double, 3> best{kWorst, kWorst, kWorst};
  for (std::size_t chains = 1; chains <= d.most_chains; ++chains)
    for (std::size_t p = 1; p <= line_of(d, 1, 1, chains).n; ++p)
      for (std::size_t w = 1; w <= line_of(d, 1, 1, chains).n; ++w) {
        const Line line = line_of(d, p, w, chains);
        const double time = plays ? schedule(line).makespan : makespan(line);
        if (d.deadline && time > *d.deadline * (1 + 1e-12)) continue;
        const double blocks = blocks_of(d, static_cast<double>(p), static_cast<double>(w), static_cast<double>(chains));
        if (d.most_blocks && blocks > *d.most_blocks * (1 + 1e-12)) continue;
        const std::array<double, 3> rank{d.goal == Goal::kTime ? time : blocks, blocks, time};
        for (std::size_t i = 0; i < 3; ++i) {
          if (std::abs(rank[i] - best[i]) <= 1e-12 * std::abs(best[i])) continue;
          if (rank[i] < best[i]) best = rank;
          break;
        }
      }
  return best;
}

/// The k-th demand: a third each for time, for blocks by a deadline, for time by blocks.
Demand some_demand(std::mt19937& random, int k) {
  Demand d = random_demand(random, 64);
  d.most_chains = 1 + static_cast<std::size_t>(k % 4);
  if (k % 3 == 1) d.goal = Goal::kBlocks, d.deadline = some_deadline(d, 0.01 * (k % 100));
  if (k % 3 == 2) d.most_blocks = blocks_of(d, 3, 4, 1);
  return d;
}

// claim    the search finds what trying everything finds, and says that it is proven
// referee  all whole numbers of proposers, weighers and chains; times by the closed form, by the schedule, played event
//          by event, for the first 12
// design   1000 demands, Q <= 64, T's over six decades; a third each for time, for blocks by a deadline, for time by
//          blocks
// twin     IntegersTwin below
TEST(Integers, AreWhatTryingEverythingFinds) {
  std::mt19937 random(1);
  for (int k = 0; k < 1000; ++k) {
    const Demand d = some_demand(random, k);
    const WholeAnswer found = optimise_whole(d);
    ASSERT_TRUE(found.feasible) << k;
    ASSERT_TRUE(found.proven) << k;
    const auto best = brute_force(d, k < 12);
    ASSERT_NEAR(found.plant.blocks, best[1], 1e-9 * best[1]) << k;
    ASSERT_NEAR(found.plant.exact_time, best[2], 1e-9 * best[2]) << k;
  }
}

/// The best real numbers of blocks, rounded up: what one would do without a search.
WholePlant rounded_up(const Demand& d) {
  const Answer real = optimise(d);
  if (!real.best) return {1, 1, 1, makespan(line_of(d, 1, 1, 1)), blocks_of(d, 1, 1, 1)};
  const Plant& plant = real[*real.best].plant;
  const std::size_t n = line_of(d, 1, 1, plant.chains).n;
  const std::size_t p = std::min(n, static_cast<std::size_t>(std::ceil(plant.proposers)));
  const std::size_t w = std::min(n, static_cast<std::size_t>(std::ceil(plant.weighers)));
  const double blocks = blocks_of(d, static_cast<double>(p), static_cast<double>(w), static_cast<double>(plant.chains));
  return {p, w, plant.chains, makespan(line_of(d, p, w, plant.chains)), blocks};
}

// twin of the above: trying everything catches an answer that was only rounded
TEST(IntegersTwin, RoundedAnswersAreCaught) {
  std::mt19937 random(1);
  int caught = 0;
  for (int k = 0; k < 100; ++k) {
    const Demand d = some_demand(random, k);
    const WholePlant found = rounded_up(d);
    const auto best = brute_force(d, false);
    const double goal = d.goal == Goal::kBlocks ? found.blocks : found.exact_time;
    const double least = d.goal == Goal::kBlocks ? best[1] : best[2];
    caught += std::abs(goal - least) > 1e-9 * least ? 1 : 0;
  }
  EXPECT_GT(caught, 10);
}

// claim    large demands are proven, too, in a thousand schedules or so
TEST(Integers, OfLargeDemandsAreProven) {
  std::mt19937 random(2);
  for (int k = 0; k < 60; ++k) {
    Demand d = random_demand(random, 1'000'000);
    if (k % 2 == 1) d.goal = Goal::kBlocks, d.deadline = some_deadline(d, 0.1);
    const WholeAnswer found = optimise_whole(d);
    EXPECT_TRUE(found.feasible && found.proven) << k;
    EXPECT_LT(found.schedules, 20'000U) << k;
  }
}

// claim    whole numbers of blocks are never quicker than real ones, where the laws bound the schedule: (L8)
TEST(Integers, NeverBeatTheChain) {
  Demand d;
  d.times = {19.2, 1, 7};
  d.kept = 840;
  const WholeAnswer found = optimise_whole(d);
  EXPECT_EQ(found.plant.proposers, 3U);
  EXPECT_EQ(found.plant.weighers, 1U);
  EXPECT_DOUBLE_EQ(found.plant.exact_time, 5900.2);
}

TEST(Integers, AnswerWhatCannotBeDoneByTheNearest) {
  Demand d;
  d.times = {19.2, 1, 7};
  d.kept = 840;
  d.goal = Goal::kBlocks;
  d.deadline = 5000;
  d.most_blocks = 100;
  const WholeAnswer found = optimise_whole(d);
  EXPECT_FALSE(found.feasible);
  EXPECT_TRUE(found.breaks_deadline);
  EXPECT_FALSE(found.breaks_blocks);
  EXPECT_DOUBLE_EQ(found.plant.exact_time, 5900.2) << "no design is quicker";
  EXPECT_EQ(found.plant.proposers, 3U);
}

TEST(Integers, TakeQueuesAndMessagesIntoAccount) {
  Demand d;
  d.times = {4, 10, 1};
  d.kept = 30;
  const double free = optimise_whole(d).plant.exact_time;
  const Message message{3, 0.5, 2};
  const WholeAnswer told = optimise_whole(d, 0, message);
  EXPECT_TRUE(told.proven);
  EXPECT_DOUBLE_EQ(told.plant.exact_time, free + 2 * (3 + 1)) << "both messages of the last";
  const WholeAnswer tight = optimise_whole(d, 1, message);
  EXPECT_TRUE(tight.proven);
  EXPECT_GT(tight.plant.exact_time, told.plant.exact_time) << "places are taken while messages are on their way";
}

}  // namespace
}  // namespace mote::design

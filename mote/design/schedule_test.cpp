#include "mote/design/schedule.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace mote::design {
namespace {

TEST(Schedule, OfOneParticleIsItsThreeStages) {
  EXPECT_DOUBLE_EQ(schedule({1, {2, 5, 1}, 3, 4}).makespan, 8);
  EXPECT_DOUBLE_EQ(makespan({1, {2, 5, 1}, 3, 4}), 8);
}

// T_p = 2, T_w = 5, T_d = 1, worked by hand: proposed at 2, 4, 6; two weighers are done at 7, 9, 12; the chain at 8,
// 10, 13.
TEST(Schedule, OfThreeParticlesByHand) {
  const Schedule found = schedule({3, {2, 5, 1}, 1, 2});
  EXPECT_DOUBLE_EQ(found.makespan, 13);
  EXPECT_DOUBLE_EQ(found.proposing, 6);
  EXPECT_DOUBLE_EQ(found.weighing, 15);
  EXPECT_EQ(found.largest_queue[0], 1U) << "the third waits from 6 to 7";
  EXPECT_EQ(found.largest_queue[1], 0U);
}

// One place before the one weigher: proposed at 2, 4, then one is held from 6 until the weigher takes the second at 7.
TEST(Schedule, AFullQueueBlocksTheStageBeforeIt) {
  const Schedule found = schedule({4, {2, 5, 1}, 1, 1, 1});
  EXPECT_DOUBLE_EQ(found.makespan, 2 + 4 * 5 + 1);
  EXPECT_DOUBLE_EQ(found.blocked, 1 + (12 - 9)) << "the third is held from 6 to 7, the fourth from 9 to 12";
  EXPECT_EQ(found.largest_queue[0], 1U);
}

// alpha = 10, beta bytes = 3: a message to the weigher and one to the chain.
TEST(Schedule, MessagesTakeTheirLatencyAndOccupyTheirLinks) {
  const Message message{10, 0.5, 6};
  EXPECT_DOUBLE_EQ(schedule({1, {2, 5, 1}, 1, 1, 0, message}).makespan, 8 + 2 * 13);
  // proposed at 1, 2, 3, the links are busy to 4, 7, 10: the slowest stage
  EXPECT_DOUBLE_EQ(schedule({3, {1, 1, 1}, 1, 1, 0, message}).makespan, 1 + 3 * 3 + 10 + 1 + 3 + 10 + 1);
}

Line random_line(std::mt19937& random) {
  std::uniform_int_distribution<std::size_t> count(1, 300);
  std::uniform_int_distribution<std::size_t> workers(1, 40);
  std::uniform_real_distribution<double> decades(-3, 3);
  return {count(random),
          {std::pow(10, decades(random)), std::pow(10, decades(random)), std::pow(10, decades(random))},
          workers(random),
          workers(random)};
}

// claim    the closed form is the makespan of the schedule
// referee  the schedule, played event by event
// design   2000 lines of up to 300 particles and 40 workers, times over six decades; relative 1e-12
// twin     a closed form whose weighers take one more particle each must be caught
TEST(Schedule, HasItsClosedForm) {
  std::mt19937 random(1);
  int caught = 0;
  for (int k = 0; k < 2000; ++k) {
    Line line = random_line(random);
    const double played = schedule(line).makespan;
    ASSERT_NEAR(makespan(line), played, 1e-12 * played) << k;
    ++line.weighers;
    caught += std::abs(makespan(line) - played) > 1e-9 * played ? 1 : 0;
  }
  EXPECT_GT(caught, 200);
}

// claim    no worker more, no place more makes a step longer: what the search over whole numbers is bounded by
TEST(Schedule, MoreOfAnythingNeverTakesLonger) {
  std::mt19937 random(2);
  for (int k = 0; k < 500; ++k) {
    Line line = random_line(random);
    line.queue = k % 3;
    line.message = k % 2 == 0 ? Message{} : Message{line.times.weigh, 0, 1};
    const double before = schedule(line).makespan;
    Line more = line;
    (k % 5 < 2 ? more.proposers : more.weighers) += 1;
    EXPECT_LE(schedule(more).makespan, before * (1 + 1e-12)) << k;
    if (line.queue == 0) continue;
    line.queue += 1;
    EXPECT_LE(schedule(line).makespan, before * (1 + 1e-12)) << k;
  }
}

// claim    the laws are bounds of the schedule where they charge too little, and near it where n is large
// referee  the schedule; n = 5000, so that what fills and drains counts for little
TEST(Schedule, LawsComeNearIt) {
  std::mt19937 random(3);
  for (int k = 0; k < 50; ++k) {
    Line line = random_line(random);
    line.n = 5000;
    const double law = single_chain_time(static_cast<double>(line.n), line.times, static_cast<double>(line.proposers),
                                         static_cast<double>(line.weighers));
    EXPECT_NEAR(law / makespan(line), 1, 0.03) << k;
  }
}

}  // namespace
}  // namespace mote::design

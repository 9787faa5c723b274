#include "mote/software/threads.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace mote {
namespace {

using namespace std::chrono_literals;

/// Waits until `done()`, ten seconds at most; whether it came true.
template <class Done>
bool came_true(const Done& done) {
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (!done() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  return done();
}

/// Processor time of this process so far.
std::chrono::duration<double> spent() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return std::chrono::seconds(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
         std::chrono::microseconds(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

/// How often each block was done, by a crew that is called `calls` times.
std::vector<int> visits(std::size_t threads, std::size_t cores, std::size_t blocks, int calls) {
  Crew crew(threads, cores);
  std::vector<int> count(blocks);
  for (int k = 0; k < calls; ++k)
    crew.run(blocks, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t b = first; b < last; ++b) ++count[b];
    });
  return count;
}

TEST(Crew, DoesEveryBlockOnce) {
  for (const std::size_t cores : {1U, 2U, 5U})
    for (const std::size_t threads : {1U, 2U, 3U, 8U})
      for (const std::size_t blocks : {0U, 1U, 31U, 32U, 33U, 98U, 977U})
        EXPECT_EQ(visits(threads, cores, blocks, 20), std::vector<int>(blocks, 20))
            << threads << " threads, " << cores << " cores, " << blocks << " blocks";
}

TEST(Crew, CallsWithOneDeskComeOneAfterTheOther) {
  Crew crew(3, 3);
  std::array<std::atomic<int>, 3> at_desk{};
  std::atomic<int> clashes = 0;
  for (int k = 0; k < 200; ++k)
    crew.run(100, [&](std::size_t desk, std::size_t, std::size_t) {
      if (++at_desk.at(desk) > 1) ++clashes;
      --at_desk.at(desk);
    });
  EXPECT_EQ(clashes, 0);
}

TEST(Crew, FewBlocksAreNotWorthAThread) {
  const Crew crew(4, 4);
  EXPECT_EQ(crew.shares(1), 1U);
  EXPECT_EQ(crew.shares(31), 1U);
  EXPECT_EQ(crew.shares(32), 2U);
  EXPECT_EQ(crew.shares(1000), 4U);
}

TEST(Crew, ThreadsWorkSideBySide) {
  Crew crew(2, 2);
  std::atomic<unsigned> seen = 0;  // a bit a desk
  std::atomic<int> alone = 0;
  crew.run(98, [&](std::size_t desk, std::size_t, std::size_t) {
    seen |= 1U << desk;
    if (!came_true([&] { return seen == 3U; })) ++alone;
  });
  EXPECT_EQ(alone, 0);
}

TEST(Crew, WhoIsDoneTakesOverWhatOthersHaveNotBegun) {
  Crew crew(2, 2);
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> held = false;
  std::atomic<bool> late = false;
  crew.run(98, [&](std::size_t desk, std::size_t first, std::size_t last) {
    if (desk == 0) came_true([&] { return held.load(); });  // so that the other one has begun
    if (desk == 1 && !held.exchange(true))
      late = !came_true([&] { return done == 98 - (last - first); });  // and does no more than that
    done += last - first;
  });
  EXPECT_TRUE(held);
  EXPECT_FALSE(late);
  EXPECT_EQ(done, 98U);
}

/// What a crew of three throws when calls with the desks of `failing` do, each a word of its own, once all three have
/// begun.
std::string thrown(Crew& crew, const std::set<std::size_t>& failing) {
  std::atomic<unsigned> seen = 0;
  try {
    crew.run(99, [&](std::size_t desk, std::size_t, std::size_t) {
      seen |= 1U << desk;
      came_true([&] { return seen == 7U; });
      if (failing.contains(desk)) throw std::runtime_error("desk " + std::to_string(desk));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Crew, WhatACallThrowsReachesTheCaller) {
  Crew crew(3, 3);
  EXPECT_EQ(thrown(crew, {0}), "desk 0");
  EXPECT_EQ(thrown(crew, {2}), "desk 2");
  EXPECT_EQ(thrown(crew, {1, 2}), "desk 1");
  EXPECT_EQ(thrown(crew, {}), "");  // nothing is left of what desk 2 threw
}

TEST(Crew, WakesFromSleep) {
  Crew crew(2, 2);
  for (int k = 0; k < 5; ++k) {
    std::this_thread::sleep_for(5ms);
    std::atomic<unsigned> seen = 0;
    crew.run(98, [&](std::size_t desk, std::size_t, std::size_t) {
      seen |= 1U << desk;
      came_true([&] { return seen == 3U; });
    });
    EXPECT_EQ(seen, 3U);
  }
}

/// The desks, a bit each, of one call for forty blocks. Who has a part of them waits for the other.
unsigned desks_of(Crew& crew) {
  std::atomic<unsigned> seen = 0;
  crew.run(40, [&](std::size_t desk, std::size_t first, std::size_t last) {
    seen |= 1U << desk;
    if (last - first < 40) came_true([&] { return seen == 3U; });
  });
  return seen;
}

TEST(Crew, ASmallStepAfterAPauseIsTheCallers) {
  Crew crew(2, 2);
  for (int k = 0; k < 20; ++k) {
    std::this_thread::sleep_for(1ms);
    EXPECT_EQ(desks_of(crew), 1U);
  }
  EXPECT_TRUE(came_true([&] { return desks_of(crew) == 3U; }));  // one that follows at once is not
}

/// Share of a core that this process uses while it does nothing for 300 ms.
template <class Worker>
double idle_load(Worker&&) {
  const auto before = spent();
  std::this_thread::sleep_for(300ms);
  return (spent() - before) / 300ms;
}

TEST(Crew, AnIdleCrewSleeps) {
  Crew crew(4, 4);
  crew.run(98, [](std::size_t, std::size_t, std::size_t) {});
  EXPECT_LT(idle_load(crew), 0.05);
}

TEST(Crew, TwinAThreadThatStaysAwakeIsCaught) {
  EXPECT_GT(idle_load(std::jthread([](const std::stop_token& stop) {
              while (!stop.stop_requested()) continue;
            })),
            0.05);
}

TEST(Crew, MovesWithItsThreads) {
  Crew first(2, 2);
  Crew second(std::move(first));
  Crew third(3, 3);
  third = std::move(second);
  std::atomic<std::size_t> done = 0;
  third.run(50, [&](std::size_t, std::size_t from, std::size_t to) { done += to - from; });
  EXPECT_EQ(done, 50U);
}

}  // namespace
}  // namespace mote

#include "mote/software/pipeline/pipeline.hpp"

#include <atomic>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "mote/software/pipeline/ring.hpp"

namespace mote {
namespace {

TEST(Ring, IsAQueueOfBoundedLength) {
  Ring ring(4);
  EXPECT_EQ(ring.pop(), std::nullopt);
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t k = 0; k < 4; ++k) EXPECT_TRUE(ring.push(10 * k));
    EXPECT_FALSE(ring.push(99));
    EXPECT_EQ(ring.size(), 4U);
    for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(ring.pop(), 10 * k);
    EXPECT_EQ(ring.pop(), std::nullopt);
  }
}

TEST(Ring, LosesAndDoublesNothingBetweenThreads) {
  constexpr std::uint32_t kEach = 20'000;
  Ring ring(8);
  std::vector<std::atomic<int>> seen(3 * kEach);
  std::atomic<std::uint32_t> popped{0};
  std::vector<std::jthread> threads;
  for (std::uint32_t p = 0; p < 3; ++p)
    threads.emplace_back([&, p] {
      for (std::uint32_t k = 0; k < kEach; ++k)
        while (!ring.push(p * kEach + k)) std::this_thread::yield();
    });
  for (int p = 0; p < 3; ++p)
    threads.emplace_back([&] {
      while (popped.load() < 3 * kEach) {
        if (const auto value = ring.pop()) {
          ++seen[*value];
          ++popped;
        } else {
          std::this_thread::yield();
        }
      }
    });
  threads.clear();
  for (const auto& count : seen) ASSERT_EQ(count.load(), 1);
}

TEST(Seats, AreForOneAtATimeFromTheLowest) {
  Seats seats(2);
  EXPECT_EQ(seats.take(), 0U);
  EXPECT_EQ(seats.take(), 1U);
  EXPECT_EQ(seats.take(), std::nullopt);
  EXPECT_FALSE(seats.take(0));
  seats.leave(0);
  EXPECT_TRUE(seats.take(0));
  seats.leave(1);
  EXPECT_EQ(seats.take(), 1U);
  Seats all(Seats::kMost);
  for (std::size_t k = 0; k < Seats::kMost; ++k) EXPECT_EQ(all.take(), k);
  EXPECT_EQ(all.take(), std::nullopt);
}

TEST(BlockFor, GivesEveryWorkerSixteenOrSo) {
  EXPECT_EQ(block_for(1'000'000, 2), 1024U);
  EXPECT_EQ(block_for(16 * 1024, 1), 1024U);
  EXPECT_EQ(block_for(16 * 1024, 2), 512U);
  EXPECT_EQ(block_for(840, 1), 32U);
  EXPECT_EQ(block_for(840, 6), 16U);
  EXPECT_EQ(block_for(1, 1), 16U);
}

/// Counts who is at work, and the most there ever were.
class Crowd {
 public:
  void enter() {
    const int now = ++now_;
    int most = most_.load();
    while (most < now && !most_.compare_exchange_weak(most, now)) continue;
  }
  void leave() { --now_; }
  int most() const { return most_.load(); }

 private:
  std::atomic<int> now_{0}, most_{0};
};

/// Lines over [0, n), of which the first has its last quarter before the rest, as chains burn in.
std::vector<std::vector<Stretch>> lines_over(std::size_t n, std::size_t lines) {
  std::vector<std::vector<Stretch>> all(lines);
  const Cut cut(n, lines);
  for (std::size_t k = 0; k < lines; ++k) {
    const std::size_t last = cut.begin(k + 1);
    const std::size_t middle = k == 0 ? last - cut.length / 4 : last;
    if (middle < last) all[k].push_back({middle, last});
    all[k].push_back({cut.begin(k), middle});
  }
  return all;
}

/// One run of stages that check on each other.
struct Trial {
  std::vector<int> proposed, weighed, taken;
  std::vector<std::vector<std::size_t>> order;  // of each line, as taken
  Crowd proposing, weighing, under_way;
  std::mutex mutex;
  std::size_t lines;

  Trial(std::size_t n, std::size_t line_count)
      : proposed(n), weighed(n), taken(n), order(line_count), lines(line_count) {}

  Stages stages(bool weighs = true, bool takes = true) {
    Stages all{{0, proposed.size()}, lines_over(proposed.size(), lines), {}, {}, {}};
    all.propose = [this](std::size_t, std::size_t, Stretch stretch) {
      proposing.enter();
      under_way.enter();
      for (std::size_t i = stretch.first; i < stretch.last; ++i) ++proposed[i];
      proposing.leave();
    };
    if (weighs)
      all.weigh = [this](Stretch stretch) {
        weighing.enter();
        for (std::size_t i = stretch.first; i < stretch.last; ++i) weighed[i] += proposed[i];
        weighing.leave();
      };
    if (takes)
      all.take = [this](Stretch stretch) {
        const Cut cut(proposed.size(), lines);
        for (std::size_t i = stretch.first; i < stretch.last; ++i) {
          taken[i] += weighed[i];
          order[cut.part_of(i)].push_back(i);
        }
        under_way.leave();
      };
    return all;
  }
};

struct Case {
  PipelineSize size;
  std::size_t particles;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::size_t n : {1U, 7U, 16U, 1000U, 1024U, 5000U})
    for (const std::size_t block : {0U, 1U, 16U, 1024U})
      for (const std::size_t threads : {1U, 2U, 5U})
        for (const auto& [rp, rw, p] : {std::tuple{1U, 1U, 1U}, {2U, 3U, 1U}, {3U, 1U, 4U}, {64U, 64U, 64U}})
          if (block != 1 || n <= 1000) all.push_back({{rp, rw, p, threads, block, {}}, n});
  return all;
}

TEST(Pipeline, PassesEveryParticleThroughEveryStageOnceAndInOrder) {
  for (const Case& c : cases()) {
    Pipeline pipeline(c.size);
    for (int step = 0; step < 2; ++step) {
      const std::size_t lines = std::min(c.size.chains, c.particles);
      Trial trial(c.particles, lines);
      pipeline.run(trial.stages());
      EXPECT_EQ(std::count(trial.taken.begin(), trial.taken.end(), 1), static_cast<long>(c.particles));
      const auto asked = lines_over(c.particles, lines);
      for (std::size_t k = 0; k < lines; ++k) {
        std::vector<std::size_t> expected;
        for (const Stretch& stretch : asked[k])
          for (std::size_t i = stretch.first; i < stretch.last; ++i) expected.push_back(i);
        EXPECT_EQ(trial.order[k], expected);
      }
      EXPECT_LE(trial.proposing.most(), static_cast<int>(c.size.proposers));
      EXPECT_LE(trial.weighing.most(), static_cast<int>(c.size.weighers));
      EXPECT_LE(trial.under_way.most(), static_cast<int>(4 * (c.size.proposers + c.size.weighers + c.size.chains)));
    }
  }
}

TEST(Pipeline, RunsStepsWithoutWeightsOrChains) {
  Pipeline pipeline({2, 2, 1, 3, 16, {}});
  for (const bool weighs : {false, true}) {
    Trial trial(1000, 1);
    pipeline.run(trial.stages(weighs, false));
    EXPECT_EQ(std::accumulate(trial.proposed.begin(), trial.proposed.end(), 0), 1000);
    EXPECT_EQ(std::accumulate(trial.weighed.begin(), trial.weighed.end(), 0), weighs ? 1000 : 0);
  }
  EXPECT_TRUE(pipeline.record().stages[2].workers.empty()) << "no chain took anything";
}

TEST(Pipeline, ChainsTakeWhileLaterBlocksAreStillToBeProposed) {
  Pipeline pipeline({1, 1, 1, 1, 16, {}});
  std::vector<char> said;
  Stages stages{{0, 48}, {{{0, 48}}}, {}, {}, {}};
  stages.propose = [&](std::size_t, std::size_t, Stretch) { said.push_back('p'); };
  stages.weigh = [&](Stretch) { said.push_back('w'); };
  stages.take = [&](Stretch) { said.push_back('c'); };
  pipeline.run(stages);
  EXPECT_EQ(std::string(said.begin(), said.end()), "pwcpwcpwc") << "one thread: what is furthest down comes first";
}

// claim    so many steps come one after the other without losing a wake-up or a block of another step
TEST(Pipeline, RunsManySmallSteps) {
  // fewer threads than workers, as many, and more
  for (const PipelineSize& size : {PipelineSize{2, 2, 3, 4, 16, {}}, {1, 1, 1, 3, 16, {}}, {3, 4, 2, 12, 16, {}}}) {
    Pipeline pipeline(size);
    for (std::size_t step = 0; step < 1000; ++step) {
      const std::size_t n = 1 + step % 200;
      Trial trial(n, std::min(size.chains, n));
      pipeline.run(trial.stages());
      ASSERT_EQ(std::count(trial.taken.begin(), trial.taken.end(), 1), static_cast<long>(n)) << step;
      if (step % 300 == 299) std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the threads fall asleep
    }
  }
}

TEST(Pipeline, HandsOnWhatAStageThrowsAndGoesOn) {
  Pipeline pipeline({2, 2, 1, 3, 16, {}});
  for (int stage = 0; stage < 3; ++stage) {
    Trial trial(500, 1);
    Stages stages = trial.stages();
    const auto fail = [](Stretch stretch) {
      if (stretch.first >= 160) throw std::runtime_error("tried");
    };
    if (stage == 0) stages.propose = [&](std::size_t, std::size_t, Stretch stretch) { fail(stretch); };
    if (stage == 1) stages.weigh = fail;
    if (stage == 2) stages.take = fail;
    EXPECT_THROW(pipeline.run(stages), std::runtime_error);
    Trial next(500, 1);
    pipeline.run(next.stages());
    EXPECT_EQ(std::count(next.taken.begin(), next.taken.end(), 1), 500);
  }
}

TEST(Pipeline, RecordsWhatItsWorkersDid) {
  Pipeline pipeline({2, 3, 1, 2, 16, {}});
  for (Step t = 1; t <= 6; ++t) {
    pipeline.begin_step(t);
    const Pipeline::Alone rest(pipeline);
    Trial trial(320, 1);
    pipeline.run(trial.stages());
  }
  const StageRecord record = pipeline.record();
  EXPECT_EQ(record.threads, 2U);
  EXPECT_GT(record.seconds, 0);
  EXPECT_GT(record.barrier_seconds, 0);
  ASSERT_EQ(record.stages.size(), 3U);
  const std::size_t workers[] = {2, 3, 1};
  for (std::size_t s = 0; s < 3; ++s) {
    const StageUse& use = record.stages[s];
    EXPECT_EQ(use.workers.size(), workers[s]);
    std::uint64_t blocks = 0;
    for (const StageWorker& worker : use.workers) {
      blocks += worker.blocks;
      EXPECT_LE(worker.busy_seconds, record.seconds);
    }
    EXPECT_EQ(blocks, 6U * 20) << use.name;
    EXPECT_LE(use.largest_queue, 24U);
    if (s > 0) {
      EXPECT_GE(use.mean_queue, 1);
    }
  }
  EXPECT_EQ(record.timeline_steps, (std::vector<Step>{2, 3, 4})) << "the first makes room";
  std::size_t spans = 0;
  for (const StageSpan& span : record.timeline) {
    EXPECT_GE(span.begin, 0);
    EXPECT_LE(span.begin, span.end);
    spans += span.stage < 3 ? 1 : 0;
  }
  EXPECT_EQ(spans, 3U * 3 * 20);
}

TEST(Pipeline, AStageOfKnownCostTakesAtLeastThatLong) {
  Pipeline pipeline({1, 2, 1, 4, 16, {0, 1e-4, 0}});
  Trial trial(64, 1);
  pipeline.begin_step(1);
  pipeline.run(trial.stages());
  const StageRecord record = pipeline.record();
  double busy = 0;
  for (const StageWorker& worker : record.stages[1].workers) busy += worker.busy_seconds;
  EXPECT_GE(busy, 64 * 1e-4);
  EXPECT_GE(record.seconds, 32 * 1e-4);
}

}  // namespace
}  // namespace mote

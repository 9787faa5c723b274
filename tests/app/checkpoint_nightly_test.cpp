// A hundred kills of one run, and of a hundred runs.

#include <gtest/gtest.h>

#include "tests/app/kills.hpp"
#include "tests/app/mpi.hpp"

namespace mote::testing {
namespace {

// Each attempt may get on by a few steps or not at all, as chance has it; the run is long enough to be killed a hundred
// times before its end.
TEST(Checkpoints, AHundredKillsChangeNoByte) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate ungm --seed 3 --out d.csv --steps 20000").code, 0);
  ASSERT_EQ(scratch.shell("mote run ungm --data d.csv -n 400000 --threads 1 --out whole.csv").code, 0);
  const Survival survival = run_and_end(scratch,
                                        {"run", "ungm", "--data", "d.csv", "-n", "400000", "--threads", "1", "--out",
                                         "e.csv", "--checkpoint", "c", "--checkpoint-every", "20"},
                                        SIGKILL, 100, 120, 5);
  EXPECT_EQ(survival.failed, 0) << survival.err;
  EXPECT_EQ(survival.ended, 100);
  EXPECT_EQ(scratch.read("e.csv"), scratch.read("whole.csv"));
  EXPECT_EQ(scratch.files().size(), 3U);
}

TEST(Checkpoints, AHundredRunsAreKilledOnceEach) {
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate ungm --seed 3 --out d.csv --steps 2000").code, 0);
  ASSERT_EQ(scratch.shell("mote run ungm --data d.csv -n 40000 --threads 1 --out whole.csv").code, 0);
  const std::string whole = scratch.read("whole.csv");
  int ended = 0;
  for (unsigned k = 0; k < 100; ++k) {
    const Survival survival = run_and_end(scratch,
                                          {"run", "ungm", "--data", "d.csv", "-n", "40000", "--threads", "1", "--out",
                                           "e.csv", "--checkpoint", "c", "--checkpoint-every", "20"},
                                          SIGKILL, 1, 300, k);
    ASSERT_EQ(survival.failed, 0) << survival.err;
    ended += survival.ended;
    ASSERT_EQ(scratch.read("e.csv"), whole) << k;
    std::filesystem::remove(scratch.path() / "e.csv");
  }
  EXPECT_GT(ended, 50) << "most are killed before they are through";
}

// Any rank, at any time: while MPI starts, steps, hands over states or ends.
TEST_F(Mpi, AHundredJobsLoseARankEach) {
  ASSERT_EQ(scratch_.shell("mote simulate ungm --seed 3 --out d.csv --steps 3000").code, 0);
  ASSERT_EQ(scratch_.shell("mote run ungm --data d.csv -n 40000 --threads 1 --out whole.csv").code, 0);
  const std::string whole = scratch_.read("whole.csv");
  const std::vector<std::string> words{"run",
                                       "ungm",
                                       "--data",
                                       "d.csv",
                                       "-n",
                                       "40000",
                                       "--out",
                                       "e.csv",
                                       "--engine",
                                       "mpi",
                                       "--checkpoint",
                                       "c",
                                       "--checkpoint-every",
                                       "20"};
  std::mt19937 random(7);
  int ended = 0;
  for (int k = 0; k < 100; ++k) {
    Job job(scratch_, 2, words);
    const auto start = std::chrono::steady_clock::now();
    job.signal_rank(random() % 2, SIGKILL, std::chrono::milliseconds(random() % 1000));
    const auto end = job.end();
    ASSERT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15)) << "a lost rank ends the job";
    if (end.code != 0) {
      ++ended;
      if (scratch_.files().contains("e.csv")) {  // the rank was lost after the first one had written
        ASSERT_EQ(scratch_.read("e.csv"), whole) << k;
      }
      ASSERT_EQ(Job(scratch_, 2, words).end().code, 0);
    }
    ASSERT_EQ(scratch_.read("e.csv"), whole) << k;
    std::filesystem::remove(scratch_.path() / "e.csv");
    std::filesystem::remove(scratch_.path() / "c");
  }
  EXPECT_GT(ended, 50);
}

// claim    memory does not grow with the steps but by what is kept of each for the outputs
// design   a million steps of 100 particles; the same command with a tenth of them
TEST(Soak, AMillionStepsTakeNoMoreThanTheirRows) {
  if (!kMemoryIsMoteOwn) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const Scratch scratch;
  const auto peak = [&](int steps) {
    EXPECT_EQ(scratch.shell("mote simulate ungm --out d.csv --steps " + std::to_string(steps)).code, 0);
    const auto end = Child(scratch, {"run", "ungm", "--data", "d.csv", "-n", "100", "--out", "e.csv"}).end();
    EXPECT_EQ(end.code, 0) << end.err;
    return end.peak_bytes;
  };
  const double tenth = peak(100'000);
  const double whole = peak(1'000'000);
  EXPECT_LT(whole - tenth, 900'000 * 1000.0) << "bytes a step";
}

}  // namespace
}  // namespace mote::testing

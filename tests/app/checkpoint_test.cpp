// A run with a checkpoint, broken off at any time in any way, gives the bytes of an unbroken run.

#include <sstream>

#include <gtest/gtest.h>

#include "tests/app/kills.hpp"

namespace mote::testing {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), {}};
}

/// A recording, the command that filters it, and what that gives when nothing breaks it off.
class Broken : public ::testing::TestWithParam<std::string> {
 protected:
  void prepare(const std::string& options, int steps) {
    ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --out d.csv --steps " + std::to_string(steps)).code, 0);
    command_ = "run bearings --data d.csv --estimate q0.9(range) " + options;
    ASSERT_EQ(scratch_.shell("mote run bearings --data d.csv --estimate 'q0.9(range)' --out whole.csv " + options).code,
              0);
  }
  std::string kept(const std::string& every) const {
    return command_ + " --out e.csv --checkpoint c --checkpoint-every " + every;
  }
  std::string in_shell(const std::string& every) const {
    std::string line = "mote " + kept(every);
    return line.replace(line.find("q0.9(range)"), 11, "'q0.9(range)'");
  }
  /// Waits until the run is at work.
  void await_checkpoint() const {
    for (int i = 0; i < 1000 && !std::filesystem::exists(scratch_.path() / "c"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  void expect_whole() const {
    EXPECT_EQ(scratch_.read("e.csv"), scratch_.read("whole.csv"));
    EXPECT_EQ(scratch_.files().size(), 3U) << "the checkpoint has served and goes; nothing else is left";
  }

  Scratch scratch_;
  std::string command_;
};

TEST_P(Broken, ByKillsAtAnyTime) {
  ASSERT_NO_FATAL_FAILURE(prepare(GetParam(), 1500));
  const Survival survival = run_and_end(scratch_, words_of(kept("7")), SIGKILL, 6, 60, 1);
  EXPECT_EQ(survival.failed, 0) << survival.err;
  EXPECT_GE(survival.ended, 1);
  expect_whole();
}

INSTANTIATE_TEST_SUITE_P(
    Checkpoint, Broken,
    ::testing::Values("-n 3000", "-n 3000 --precision float --ess-threshold 0.5",
                      "-n 500 --resampler residual --selection-exponent 0.5", "-n 300 --engine reference",
                      "-n 2000 --filter imh --improved", "-n 300 --filter imh --burn-in auto",
                      "-n 1000 --filter auxiliary --engine simd --chains 4",
                      "-n 300 --filter auxiliary --parent-weights lookahead",
                      "-n 300 --filter distributed --groups 4 --exchange swap --topology hypercube",
                      "-n 300 --filter imh --chains 2 --engine pipeline --weighers 2", "-n 300 --filter sqmc",
                      "-n 300 --filter ekf", "-n 300 --filter ukf", "-n 300 --proposal guided --on-collapse reset"));

class Checkpoints : public Broken {};

TEST_F(Checkpoints, CtrlCLeavesOneAndSaysSo) {
  prepare("-n 20000", 400);
  Child child(scratch_, words_of(kept("1")));
  await_checkpoint();
  child.signal(SIGINT);
  const auto end = child.end();
  EXPECT_EQ(end.code, 130);
  EXPECT_NE(end.err.find(" of 400 steps; the same command goes on from c.\n"), std::string::npos) << end.err;
  EXPECT_TRUE(scratch_.files().contains("c"));
  EXPECT_FALSE(scratch_.files().contains("e.csv"));
  const Ended ended = scratch_.shell(in_shell("1000000") + " --threads 3");
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "c: note: the run goes on from there.\n");
  EXPECT_NE(ended.out.find("400 steps estimated"), std::string::npos) << ended.out;
  expect_whole();
}

TEST_F(Checkpoints, OfAPipelineFitAnyNumberOfWorkers) {
  prepare("-n 20000 --filter imh --engine pipeline --proposers 2", 100);
  Child child(scratch_, words_of(kept("1")));
  await_checkpoint();
  child.signal(SIGINT);
  EXPECT_EQ(child.end().code, 130);
  std::string resumed = in_shell("1000000");
  resumed.replace(resumed.find("--proposers 2"), 13, "--proposers 1 --weighers 3 --threads 4");
  EXPECT_EQ(scratch_.shell(resumed).err, "c: note: the run goes on from there.\n");
  expect_whole();
}

TEST_F(Checkpoints, RepeatedCtrlCGetsThrough) {
  prepare("-n 20000", 400);
  const Survival survival = run_and_end(scratch_, words_of(kept("1000000")), SIGTERM, 5, 120, 2);
  EXPECT_EQ(survival.failed, 0) << survival.err;
  expect_whole();
}

// The file grows with the estimates, until a limit on the size of files stops it: the one before stays whole.
TEST_F(Checkpoints, AFullDiskLosesNothing) {
  prepare("-n 300", 300);
  const Ended full = scratch_.shell("ulimit -f 60; " + in_shell("1"));  // 30 kB
  EXPECT_EQ(full.code, 6);
  EXPECT_EQ(full.err,
            "c: expected an output that can be written, got File too large. Check that the folder exists and can be "
            "written.\n");
  EXPECT_FALSE(scratch_.files().contains("e.csv"));
  EXPECT_GT(scratch_.read("c").size(), 29000U) << "the last that fitted";
  const std::string last = scratch_.read("c");
  EXPECT_EQ(scratch_.shell("ulimit -f 60; " + in_shell("1")).code, 6);
  EXPECT_EQ(scratch_.read("c"), last);
  EXPECT_EQ(scratch_.shell(in_shell("1")).code, 0);
  expect_whole();
}

TEST_F(Checkpoints, OfAnotherRunAreRefusedAndKept) {
  prepare("-n 300", 300);
  ASSERT_EQ(scratch_.shell("ulimit -f 60; " + in_shell("1")).code, 6);
  scratch_.shell("mote simulate bearings --seed 4 --out other.csv --steps 300");
  const auto before = scratch_.files();
  const std::string run = in_shell("1");
  const auto refused = [&](const std::string& more, const std::string& sentence) {
    const Ended ended = scratch_.shell(run + more);
    EXPECT_EQ(ended.code, 2) << more;
    EXPECT_NE(ended.err.find(sentence), std::string::npos) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(scratch_.files(), before) << more;
  };
  refused(" -n 301", "c: expected a checkpoint of this run, with --particles 301, got one with --particles 300.");
  refused(" --seed 2", "with --seed 2, got one with --seed 1.");
  refused(" --precision float", "with --precision float, got one with --precision double.");
  refused(" --engine reference", "with --engine reference, got one with --engine simd.");
  refused(" --ess-threshold 0.5", "with --ess-threshold 0.5, got");
  refused(" --filter sqmc", "with --filter sqmc, got");
  refused(" --set sigma_u=0.002", "with --set sigma_u=0.002, got one with --set not given.");
  refused(" --estimate 'mean(x)'", "with --estimate q0.9(range) mean(x), got");
  refused(" --data other.csv", "with --data of 300 steps, checksum ");
}

TEST_F(Checkpoints, KnowTheFileOfAModel) {
  const std::string matrices = "Q=[[1]]\nH=[[1]]\nR=[[1]]\nmean=[0]\ncovariance=[[1]]\n";
  scratch_.write("m.toml", "F=[[0.5]]\n" + matrices);
  scratch_.write("d.csv", "t,y\n1,1\n9000000,1\n");
  const std::string run =
      "run linear-gaussian --data d.csv --set file=m.toml -n 100 --out e.csv --checkpoint c --checkpoint-every 1000";
  Child child(scratch_, words_of(run));
  await_checkpoint();
  child.signal(SIGINT);
  EXPECT_EQ(child.end().code, 130) << "within a gap, too";
  scratch_.write("m.toml", "F=[[0.6]]\n" + matrices);
  const Ended ended = scratch_.shell("mote " + run);
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("with matrices of checksum "), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace mote::testing

// A hundred kills of one run.

#include <gtest/gtest.h>

#include "tests/app/kills.hpp"

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

}  // namespace
}  // namespace mote::testing

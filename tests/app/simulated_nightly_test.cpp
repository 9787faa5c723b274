// A thousand simulated ranks.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

// claim    1024 ranks of a million particles of the growth model each are at least 90 % as fast as one is
// referee  SimGrid, platform modern, this machine's time for a particle
TEST(ManySimulatedRanks, AreNinetyPercentEfficient) {
  if (!kSimulates) GTEST_SKIP() << "built without SimGrid";
  const Scratch scratch;
  const Ended ended = scratch.shell("mote simulate-cluster ungm --ranks 1024 -n 1000000 --steps 5 --json s.json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto run = nlohmann::json::parse(scratch.read("s.json")).at("runs").back();
  EXPECT_EQ(run.at("ranks"), 1024);
  EXPECT_GE(run.at("efficiency").get<double>(), 0.9);
}

}  // namespace
}  // namespace mote::testing

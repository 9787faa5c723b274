// The memory and the start of a run: every resampler, every filter. All pairs of them: memory_nightly_test.cpp.

#include "mote/app/commands/memory.hpp"

#include <chrono>

#include "mote/app/commands/job.hpp"
#include "tests/app/memory.hpp"

namespace mote::testing {
namespace {

class Memory : public ::testing::TestWithParam<MemoryCase> {};

// claim    peak memory of a run is at most 64 bytes x N x states + 64 MB
// referee  the operating system's account of the child
TEST_P(Memory, StaysWithinItsBound) { expect_within_bound(GetParam()); }

std::vector<MemoryCase> cases() {
  std::vector<MemoryCase> all;
  for (const Scheme& scheme : schemes())
    all.push_back({"ungm", 2'000'000, 1, "--resampler " + std::string(scheme.name)});
  for (const std::string filter :
       {"sisr", "imh --improved", "imh --burn-in auto", "auxiliary --parent-weights lookahead",
        "distributed --groups 8 --exchange swap", "sqmc", "ukf"})
    all.push_back({"bearings", 500'000, 4, "--filter " + filter});
  all.push_back({"ungm", 2'000'000, 1, "--filter imh"});
  all.push_back({"ungm", 2'000'000, 1, "--filter sqmc"});
  all.push_back({"ungm", 2'000'000, 1, "--filter ekf"});
  all.push_back({"ungm", 2'000'000, 1, "--estimate median(x)"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Runs, Memory, ::testing::ValuesIn(cases()));

// A dump is written particle by particle, not gathered.
TEST(MemoryOfADump, IsThatOfARun) { expect_within_bound({"ungm", 300'000, 1, "--dump-particles /dev/null"}); }

TEST(AvailableMemory, IsPositiveAndFollowsTheLimit) {
  EXPECT_GT(available_memory(), 0);
  if (!kMemoryIsMoteOwn) GTEST_SKIP() << "a sanitizer takes address space of its own";
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit limit{rlim_t{1} << 30U, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const double limited = available_memory();
  setrlimit(RLIMIT_AS, &before);
  EXPECT_LT(limited, 1 << 30U);
}

// The bound that refuses a run too large for the machine is no less than what runs take.
TEST(BytesNeeded, CoverWhatARunTakes) {
  if (!kMemoryIsMoteOwn) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate ungm --steps 3 --out d.csv").code, 0);
  const std::size_t few = 1000;
  const std::size_t many = 1'000'000;
  for (const Scheme& scheme : schemes()) {
    const auto peak = [&](std::size_t n) {
      return Child(scratch,
                   {"run", "ungm", "--data", "d.csv", "--resampler", std::string(scheme.name), "-n", std::to_string(n)})
          .end()
          .peak_bytes;
    };
    Plan plan;
    plan.particles = many;
    plan.selection.scheme = &scheme;
    EXPECT_LE(peak(many) - peak(few), bytes_needed(plan, 1) + 1e6) << scheme.name;
  }
}

// The median is asked for no more than 20 ms; a busy machine is not a fault of mote, so it is told, not judged.
TEST(Start, IsTimed) {
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1100\n2,1000\n");
  std::vector<double> milliseconds;
  for (int i = 0; i < 20; ++i) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(Child(scratch, {"run", "local-level", "--data", "d.csv", "--out", "e.csv"}).end().code, 0);
    milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  std::printf("mote run on two rows: median %.1f ms, least %.1f, most %.1f (asked: 20)\n", milliseconds[10],
              milliseconds.front(), milliseconds.back());
  RecordProperty("median_ms", std::to_string(milliseconds[10]));
}

}  // namespace
}  // namespace mote::testing

#include "mote/app/terminal/ranks.hpp"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>
#include <sys/time.h>

namespace mote {
namespace {

using std::chrono::milliseconds;

/// This process as mpirun would have started it.
class Ranks : public ::testing::Test {
 protected:
  static void be(const char* rank, const char* first_ranks) {
    setenv("OMPI_COMM_WORLD_RANK", rank, 1);
    setenv("OMPI_FIRST_RANKS", first_ranks, 1);
  }
  void TearDown() override {
    unsetenv("OMPI_COMM_WORLD_RANK");
    unsetenv("OMPI_FIRST_RANKS");
  }
  /// How long the answer took.
  static milliseconds taken(bool speaks, milliseconds patience) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(speaks_for_job(patience), speaks);
    return std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
  }
};

TEST_F(Ranks, TheFirstSpeaksAtOnce) {
  constexpr milliseconds kLong(60'000);
  EXPECT_LT(taken(true, kLong), kLong) << "nobody else is there";
  be("0", "0");
  EXPECT_LT(taken(true, kLong), kLong);
  be("3", "0 3");
  EXPECT_LT(taken(true, kLong), kLong) << "the first of the second command line";
  unsetenv("OMPI_FIRST_RANKS");
  setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  EXPECT_LT(taken(true, kLong), kLong);
}

TEST_F(Ranks, TheOthersSpeakIfTheyOutliveIt) {
  be("2", "0 3");
  EXPECT_GE(taken(true, milliseconds(50)), milliseconds(50));
  EXPECT_GE(taken(true, milliseconds(1020)), milliseconds(1020));
}

TEST_F(Ranks, ASignalMeansThatItWasSaid) {
  be("1", "0");
  struct sigaction action {};
  action.sa_handler = [](int) {};
  struct sigaction before {};
  sigaction(SIGALRM, &action, &before);
  const itimerval soon{{0, 10'000}, {0, 10'000}};  // again and again: the first may come before the wait
  setitimer(ITIMER_REAL, &soon, nullptr);
  constexpr milliseconds kLong(60'000);
  EXPECT_LT(taken(false, kLong), kLong);
  const itimerval never{};
  setitimer(ITIMER_REAL, &never, nullptr);
  sigaction(SIGALRM, &before, nullptr);
}

}  // namespace
}  // namespace mote

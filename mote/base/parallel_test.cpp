#include "mote/base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace mote {
namespace {

TEST(InParallel, DoesEveryPieceOnceAndHandsErrorsOn) {
  std::vector<std::atomic<int>> done(1000);
  in_parallel(done.size(), 3, [&](std::size_t k) { ++done[k]; });
  EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](const auto& d) { return d == 1; }));
  EXPECT_THROW(in_parallel(1000, 3,
                           [](std::size_t k) {
                             if (k == 500) throw std::runtime_error("no");
                           }),
               std::runtime_error);
  in_parallel(0, 3, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace mote

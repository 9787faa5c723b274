#include "mote/engine/latency.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

// T_p = 2, T_w = 5, T_d = 1, K_p = 7, K_w = 11, n = Q + N_b = 90 + 10; every expected value worked by hand.
constexpr StageTimes kTimes{2, 5, 1};
constexpr StageLatencies kLatencies{7, 11};

TEST(Latency, OfTheSequentialArchitecture) {
  EXPECT_DOUBLE_EQ(sequential_time(100, kTimes, kLatencies), 99 * 5 + 7 + 11 + 1);
  EXPECT_DOUBLE_EQ(sequential_time(100, {2, 5, 9}, kLatencies), 99 * 9 + 7 + 11 + 9) << "the chain may be the slowest";
}

TEST(Latency, OfUnboundedResources) { EXPECT_DOUBLE_EQ(unbounded_time(100, kTimes, kLatencies), 118); }

TEST(Latency, OfPairsOfProposerAndWeigher) {
  EXPECT_DOUBLE_EQ(paired_time(100, 2, kTimes, kLatencies), 18 + 49 * 5 + 2);
  EXPECT_DOUBLE_EQ(paired_time(100, 5, kTimes, kLatencies), 18 + 19 * 5 + 5);
  EXPECT_DOUBLE_EQ(paired_time(100, 6, kTimes, kLatencies), 118) << "more pairs than the chain can follow";
  EXPECT_EQ(best_pairs(kTimes), 5U);
  EXPECT_EQ(best_pairs({2, 5, 2}), 3U);
  EXPECT_EQ(best_pairs({2, 5, 6}), 1U);
}

TEST(Latency, OfCopies) { EXPECT_DOUBLE_EQ(proposals_of_a_copy(1000, 10, 4), 260); }

TEST(Latency, OfASingleChainInEachCase) {
  // A: rates 1/2 <= 3/5 <= 1
  EXPECT_EQ(bottleneck_of(kTimes, 1, 3), Bottleneck::kProposals);
  EXPECT_DOUBLE_EQ(single_chain_time(100, kTimes, 1, 3), 200 + 5.0 / 3 + 3);
  // B: 2/5 the least of 1/2, 2/5, 1
  EXPECT_EQ(bottleneck_of(kTimes, 1, 2), Bottleneck::kWeights);
  EXPECT_DOUBLE_EQ(single_chain_time(100, kTimes, 1, 2), 4 + 250 + 2);
  EXPECT_DOUBLE_EQ(single_chain_time(100, kTimes, 3, 1), 2 + 500 + 1) << "the first proposal takes T_p, not T_p/3";
  // C: 1/2 <= 1 <= 6/5
  EXPECT_EQ(bottleneck_of(kTimes, 1, 6), Bottleneck::kProposalsThenChain);
  EXPECT_DOUBLE_EQ(single_chain_time(100, kTimes, 1, 6), 200 + 5 + 1);
  // D: 1 the least of 3/2, 6/5, 1
  EXPECT_EQ(bottleneck_of(kTimes, 3, 6), Bottleneck::kChain);
  EXPECT_DOUBLE_EQ(single_chain_time(100, kTimes, 3, 6), 2 + 5 + 100);
}

TEST(Latency, AChainMayTakeNoTime) {
  EXPECT_EQ(bottleneck_of({2, 5, 0}, 1, 1), Bottleneck::kWeights);
  EXPECT_DOUBLE_EQ(single_chain_time(100, {2, 5, 0}, 1, 1), 2 + 500);
}

// claim    the corrected cases meet where all rates are equal
// referee  T_p : T_w : T_d = 19.2 : 1 : 7 and Q = 840 of IMH-OPT section V-B: Q T_d + T_p + T_w = 5900.2
TEST(Latency, EveryCaseHasThePapersMinimum) {
  const StageTimes times{19.2, 1, 7};
  for (const auto which :
       {Bottleneck::kProposals, Bottleneck::kWeights, Bottleneck::kProposalsThenChain, Bottleneck::kChain})
    EXPECT_NEAR(single_chain_time(which, 840, times, 19.2 / 7, 1.0 / 7), 5900.2, 1e-9);
}

TEST(Latency, OfResamplingIncludesItsBarrier) {
  EXPECT_DOUBLE_EQ(barrier_time(100, kTimes, 1, 3, 40), 200 + 5 + 40);
  EXPECT_DOUBLE_EQ(barrier_time(100, kTimes, 1, 2, 40), 4 + 250 + 40);
  EXPECT_DOUBLE_EQ(barrier_time(100, kTimes, 3, 1, 40), 2 + 500 + 40);
  EXPECT_DOUBLE_EQ(barrier_time(100, {5, 1, 0}, 3, 1, 0), 500.0 / 3 + 3) << "three proposals are weighed at the end";
}

}  // namespace
}  // namespace mote

#include "mote/filter/chain.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

std::vector<double> logs(std::vector<double> weights) {
  for (double& w : weights) w = std::log(w);
  return weights;
}

/// Runs chains whose every comparison is decided by `log_uniform`.
std::vector<Index> picks_of(const ChainLayout& layout, const std::vector<double>& log_weights, double log_uniform,
                            const std::vector<Index>& starts = {}, ChainReport* report = nullptr) {
  std::vector<Index> picks(layout.kept);
  const std::vector<double> uniforms(layout.proposals(), log_uniform);
  const ChainReport got = run_chains(layout, log_weights, uniforms, starts, picks);
  if (report != nullptr) *report = got;
  return picks;
}

constexpr double kAlways = -kInfinity;  // a log uniform that accepts everything
constexpr double kNever = 0;            // one that accepts only a strictly heavier proposal

TEST(Chain, KeepsTheLastStatesOfItsOwnPart) {
  // 3 chains, 7 of 11 kept: parts 4 4 3 of the draws, 3 2 2 of the kept
  const ChainLayout layout{7, 11, 3, 2};
  EXPECT_EQ(layout.proposals(), 17U);
  EXPECT_EQ(picks_of(layout, std::vector<double>(17, 0.0), kAlways), (std::vector<Index>{1, 2, 3, 6, 7, 9, 10}));
}

TEST(Chain, BurnsInOnTheProposalsBehindTheDraws) {
  const ChainLayout layout{4, 4, 2, 2};  // chain 0 burns in on 4 5, chain 1 on 6 7
  std::vector<double> log_weights(8, 0.0);
  EXPECT_EQ(picks_of(layout, log_weights, kNever), (std::vector<Index>{4, 4, 6, 6}))
      << "the first burn-in proposal is the start";
  log_weights[5] = log_weights[7] = 3;
  EXPECT_EQ(picks_of(layout, log_weights, kNever), (std::vector<Index>{5, 5, 7, 7}))
      << "the last burn-in states begin the kept part";
}

TEST(Chain, StartsAtItsFirstProposalWithoutOfferingIt) {
  ChainReport report;
  EXPECT_EQ(picks_of({3, 3, 1, 0}, {0, 0, 0}, kNever, {}, &report), (std::vector<Index>{0, 0, 0}));
  EXPECT_EQ(report.offered, 2U);
  EXPECT_EQ(report.accepted, 0U);
  picks_of({3, 3, 1, 0}, {0, 0, 0}, kAlways, {}, &report);
  EXPECT_EQ(report.accepted, 2U);
}

TEST(Chain, StartsWhereItIsToldAndOffersEveryOtherProposal) {
  ChainReport report;
  EXPECT_EQ(picks_of({4, 4, 2, 0}, {0, 0, 0, 0}, kNever, {3, 0}, &report), (std::vector<Index>{3, 3, 0, 0}));
  EXPECT_EQ(report.offered, 4U);
  // chain 0 starts at its own second proposal: it is no independent proposal any more and is passed over
  EXPECT_EQ(picks_of({4, 4, 2, 0}, {0, 0, 0, 0}, kAlways, {1, 1}, &report), (std::vector<Index>{0, 0, 2, 3}));
  EXPECT_EQ(report.offered, 3U);
}

TEST(Chain, LeavesAStartOfWeightZeroAtOnce) {
  const double zero = -kInfinity;
  EXPECT_EQ(picks_of({4, 4, 1, 0}, {zero, zero, 0, zero}, kNever), (std::vector<Index>{0, 0, 2, 2}));
  EXPECT_EQ(picks_of({4, 4, 1, 0}, {zero, zero, 0, zero}, kAlways), (std::vector<Index>{0, 0, 2, 2}))
      << "a proposal of weight zero is never accepted after one of positive weight";
}

/// z score of a count of `hits` among n independent tries of probability p.
double z(double hits, double n, double p) { return (hits - n * p) / std::sqrt(n * p * (1 - p)); }

/// How often each of 4 proposals is the last state of a chain over `calls` sets of uniforms; the law of log u is exact.
std::vector<double> last_states(const std::vector<double>& log_weights, int calls) {
  std::vector<double> counts(4);
  for (int c = 1; c <= calls; ++c) {
    std::vector<double> uniforms(4);
    Draws{static_cast<std::uint64_t>(c), 1}.for_each(
        Purpose::kAccept, 0, 4, [&](std::size_t j, auto& draw) { uniforms[j] = std::log(draw.uniform()); });
    std::vector<Index> pick(1);
    run_chains({1, 4, 1, 0}, log_weights, uniforms, {}, pick);
    ++counts[pick[0]];
  }
  return counts;
}

// claim    proposal j is accepted after i with probability min(w_j / w_i, 1)
// referee  the law of the last state, by the recursion over the three decisions
// design   40 000 sets of uniforms for the weights 4, 1, 2, 1
// risk     1e-6 (|z| < 5.2 over four states); the twin (weights swapped) must be caught
TEST(Chain, HasTheLawOfItsDecisions) {
  const std::vector<double> w{4, 1, 2, 1};
  std::vector<double> law{1, 0, 0, 0};
  for (std::size_t j = 1; j < 4; ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const double moved = law[i] * std::min(w[j] / w[i], 1.0);
      law[i] -= moved;
      law[j] += moved;
    }
  constexpr int kCalls = 40000;
  const auto worst = [&](const std::vector<double>& counts) {
    double most = 0;
    for (std::size_t j = 0; j < 4; ++j) most = std::max(most, std::abs(z(counts[j], kCalls, law[j])));
    return most;
  };
  EXPECT_LT(worst(last_states(logs(w), kCalls)), 5.2);
  EXPECT_GT(worst(last_states(logs({4, 2, 1, 1}), kCalls)), 5.2) << "the twin";
}

// claim    the stationary law of the kept states is the weights'
// referee  the weights of five values, proposed uniformly
// design   400 chains of 2000 proposals, 500 for burning in; z from the spread between the chains
// risk     1e-6 (|z| < 5.4 over five values, t with 399 degrees); the twin (a chain that accepts everything) must be
// caught
TEST(Chain, SettlesIntoTheWeights) {
  const std::vector<double> w{0.1, 1, 3, 0, 5.9};
  const auto worst = [&](bool decide) {
    constexpr int kChains = 400;
    const ChainLayout layout{1500, 1500, 1, 500};
    std::array<double, 5> sums{};
    std::array<double, 5> squares{};
    for (int c = 1; c <= kChains; ++c) {
      const Draws draws{static_cast<std::uint64_t>(c), 2};
      std::vector<std::size_t> value(layout.proposals());
      std::vector<double> log_weights(layout.proposals());
      std::vector<double> uniforms(layout.proposals(), kAlways);
      draws.for_each(Purpose::kMove, 0, value.size(), [&](std::size_t j, auto& draw) {
        value[j] = draw.index(5);
        log_weights[j] = std::log(w[value[j]]);
      });
      if (decide)
        draws.for_each(Purpose::kAccept, 0, value.size(),
                       [&](std::size_t j, auto& draw) { uniforms[j] = std::log(draw.uniform()); });
      std::vector<Index> picks(layout.kept);
      run_chains(layout, log_weights, uniforms, {}, picks);
      std::array<double, 5> share{};
      for (const Index p : picks) share[value[p]] += 1.0 / 1500;
      for (std::size_t v = 0; v < 5; ++v) {
        sums[v] += share[v];
        squares[v] += share[v] * share[v];
      }
    }
    double most = 0;
    for (std::size_t v = 0; v < 5; ++v) {
      const double mean = sums[v] / kChains;
      const double error = std::sqrt((squares[v] / kChains - mean * mean) / kChains);
      most = std::max(most, w[v] > 0 ? std::abs(mean - w[v] / 10) / error : (decide ? 1e9 : 0) * sums[v]);
    }
    return most;
  };
  EXPECT_LT(worst(true), 5.4);
  EXPECT_GT(worst(false), 5.4) << "the twin";
}

// (1 - mean/largest)^n <= distance for the n returned, and for no smaller one
TEST(Chain, BurnInIsTheSmallestThatIsCloseEnough) {
  for (const double ratio : {0.9, 0.5, 0.1, 0.013})
    for (const double distance : {0.1, 0.01, 1e-4}) {
      const auto n = static_cast<double>(burn_in_for(ratio * 7, 7, distance, 1000000));
      EXPECT_LE(std::pow(1 - ratio, n), distance * (1 + 1e-9));
      EXPECT_GT(std::pow(1 - ratio, n - 1), distance * (1 - 1e-9));
    }
  EXPECT_EQ(burn_in_for(1, 1, 0.01, 100), 0U) << "equal weights need none";
  EXPECT_EQ(burn_in_for(1e-9, 1, 0.01, 100), 100U) << "never more than the most";
}

}  // namespace
}  // namespace mote

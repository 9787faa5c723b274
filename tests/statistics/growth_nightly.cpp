#include <gtest/gtest.h>

#include "tests/statistics/growth.hpp"

namespace mote::statistics {
namespace {

// claim    the error of systematic SISR to the exact mean is at most 0.52 (expected 0.487), IMH pays at most 1.75 times
// the MSE with one chain and
//          1.45 with 8 permuted chains from a weighted start, at an equal number of likelihoods
// referee  the point-mass filter
// design   2000 recordings of 100 steps, N = 1000, seeds 1..2000; medians, because a few recordings with a lost mode
// rule the means risk     RMSE has a standard error of 0.011, the ratios 3 %: the goals are 3, 5 and 3 standard errors
// from what is expected
TEST(GrowthNightly, ErrorsToTheExactMeanAreTheGoals) {
  auto makers = growth_filters();
  const Ungm<1> model;
  const auto imh = [&](const std::string& name, const ChainOptions& options) {
    makers.push_back(
        {"imh, " + name, [=](std::size_t n, std::uint64_t seed) { return make_imh(model, n, seed, options); }});
  };
  imh("8 chains", {.chains = 8});
  imh("one chain, permuted, weighted start", {.parents = Parents::kPermuted, .start = ChainStart::kWeighted});
  imh("8 chains, weighted start, parents swept",
      {.chains = 8, .parents = Parents::kSweep, .start = ChainStart::kWeighted});
  const PairedErrors errors = paired_errors(makers, 2000);
  print(errors);
  EXPECT_LE(errors.rmse(0).mean(), 0.52);
  EXPECT_LE(errors.ratio_of_medians(1), 1.75);
  EXPECT_LE(errors.median_ratio(1), 1.75);
  EXPECT_LE(errors.ratio_of_medians(2), 1.45);
  EXPECT_LE(errors.median_ratio(2), 1.45);
}

}  // namespace
}  // namespace mote::statistics

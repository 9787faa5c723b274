#include <gtest/gtest.h>

#include "tests/statistics/growth.hpp"

namespace mote::statistics {
namespace {

// claim    the error of systematic SISR to the exact mean is at most 0.52, IMH pays at most 1.75 times the MSE with
//          one chain and 1.45 with 8 permuted chains from a weighted start, at an equal number of likelihoods
// referee  the point-mass filter
// design   2000 recordings of 100 steps, N = 1000, seeds 1..2000; medians, because a few recordings with a lost mode
//          rule the means
// risk     fixed seeds, so none once it passes. Measured: RMSE 0.512 with a standard error of 0.012 (an independent
//          filter on the same recordings: 0.504 +- 0.010), ratios 1.45 and 1.32 with 0.03: new seeds would fail the
//          RMSE one time in four
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

// claim    one particle sent by each group to the next recovers at least half of the error that local resampling makes
//          against global, as copies or by changing places; RPA is as good as global
// referee  the point-mass filter
// design   300 recordings of 100 steps, N = 1000 in 16 groups; recovered = (local - scheme) / (local - global) of the
//          median square errors
// risk     none: fixed seeds. Measured 0.69 (append) and 0.77 (swap); the twin (groups that exchange nothing, of
//          other seeds) must recover less than half
TEST(GrowthNightly, OneSharedParticleRecoversHalf) {
  const Ungm<1> model;
  const auto groups = [&](const std::string& name, GroupOptions options, std::uint64_t apart = 0) {
    options.groups = 16;
    return Maker{name,
                 [=](std::size_t n, std::uint64_t seed) { return make_distributed(model, n, seed + apart, options); }};
  };
  const PairedErrors errors = paired_errors(
      {groups("global", {.resampling = GroupResampling::kGlobal}), groups("local", {}),
       groups("append", {.exchange = Exchange::kAppend}), groups("swap", {.exchange = Exchange::kSwap}),
       groups("rpa", {.resampling = GroupResampling::kProportional}), groups("local, other seeds", {}, 100000)},
      300);
  print(errors);
  const auto recovered = [&](std::size_t i) {
    return (errors.ratio_of_medians(1) - errors.ratio_of_medians(i)) / (errors.ratio_of_medians(1) - 1);
  };
  for (std::size_t i = 2; i < errors.names.size(); ++i)
    measured("ungm, 16 groups, recovered, " + errors.names[i], recovered(i), errors.relative_error(i));
  EXPECT_GE(recovered(2), 0.5);
  EXPECT_GE(recovered(3), 0.5);
  EXPECT_NEAR(errors.ratio_of_medians(4), 1, 0.25);
  EXPECT_LT(recovered(5), 0.5) << "the twin";
}

}  // namespace
}  // namespace mote::statistics

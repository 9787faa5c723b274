// The memory of a run for every filter with every resampler.

#include "mote/filter/resample/schemes.hpp"
#include "tests/app/memory.hpp"

namespace mote::testing {
namespace {

class EveryPair : public ::testing::TestWithParam<MemoryCase> {};

TEST_P(EveryPair, StaysWithinItsBound) { expect_within_bound(GetParam()); }

std::vector<MemoryCase> cases() {
  std::vector<MemoryCase> all;
  const auto add = [&](const std::string& options) {
    all.push_back({"ungm", 2'000'000, 1, options});
    all.push_back({"bearings", 500'000, 4, options});
  };
  for (const Scheme& scheme : schemes())
    for (const std::string filter :
         {"sisr", "sisr --ess-threshold 0.5", "distributed --groups 8 --exchange append",
          "distributed --groups 8 --exchange replace", "distributed --groups 8 --exchange swap",
          "distributed --groups 8 --group-resampling global"})
      add("--filter " + filter + " --resampler " + std::string(scheme.name));
  for (const std::string filter :
       {"imh", "imh --improved", "imh --burn-in auto", "imh --parents sweep", "auxiliary", "auxiliary --improved",
        "auxiliary --parent-weights lookahead", "sqmc", "sqmc --precision float", "ekf", "ukf"})
    add("--filter " + filter);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Runs, EveryPair, ::testing::ValuesIn(cases()));

}  // namespace
}  // namespace mote::testing

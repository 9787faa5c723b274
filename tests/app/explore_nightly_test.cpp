// `mote design explore` at full length: its pick against a sweep of all candidates.

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

Json explored(const Scratch& scratch, const std::string& words) {
  const Ended ended = scratch.shell("mote design explore ungm --json e.json --state s " + words);
  EXPECT_EQ(ended.code, 0) << ended.err;
  return Json::parse(scratch.read("e.json"));
}

/// What a candidate of another exploration came to in this one.
const Json& of(const Json& sweep, const Json& pick) {
  const auto found = std::find_if(sweep["all"].begin(), sweep["all"].end(),
                                  [&](const Json& one) { return one["words"] == pick["words"]; });
  if (found == sweep["all"].end()) throw std::runtime_error("no candidate " + pick["words"].dump());
  return *found;
}

// claim    the pick by halving errs at most 5 % more than the best of a sweep
// referee  all candidates by all 128 runs; the state hands over what they take, so that both have the same costs
void expect_near_the_best(const std::string& words) {
  const Scratch scratch;
  const Json found = explored(scratch, words);
  const Json sweep = explored(scratch, words + " --first-runs 128");
  ASSERT_TRUE(found["pick"]["feasible"].get<bool>());
  EXPECT_LE(of(sweep, found["pick"])["rmse"].get<double>(), 1.05 * sweep["pick"]["rmse"].get<double>())
      << found["pick"].dump() << "\n"
      << sweep["pick"].dump();
}

TEST(ExploreNightly, PicksAFilterNearTheBest) { expect_near_the_best("--target cpu --deadline 20us"); }

TEST(ExploreNightly, PicksACircuitNearTheBest) {
  expect_near_the_best("--target fpga:xc7a100t --deadline 20us --max-lut 4000 --max-power 300mW");
}

// claim    a circuit's area, clock and power by parts are near those of the whole
// referee  mote rtl --synth xc7
TEST(ExploreNightly, EstimatesCircuitsByTheirParts) {
  const Scratch scratch;
  const Json found = explored(scratch,
                              "--target fpga:xc7a100t -n 256,1000 --more-bits 0 --workers 4 --first-runs 1 --runs 1 "
                              "--recordings 1 --steps 10");
  for (const char* words : {"--arch imh --overlap -n 1000", "--arch sisr -n 1000", "--arch sisr -n 256",
                            "--arch imh-parallel --overlap -n 1000 --lanes 4", "--arch sisr-lanes -n 1000 --lanes 4",
                            "--arch groups -n 1000 --lanes 4"}) {
    const Json& estimate = of(found, {{"words", words}});
    const Ended ended = scratch.shell(std::string("mote rtl ungm --synth xc7 --json c.json ") + words);
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json whole = Json::parse(scratch.read("c.json"));
    for (const auto& [ours, theirs, share] :
         std::vector<std::tuple<const char*, const char*, double>>{{"lut", "lut", 0.15},
                                                                   {"ff", "ff", 0.15},
                                                                   {"dsp", "dsp", 0.15},
                                                                   {"bram18", "bram18", 0.25},
                                                                   {"clock_mhz", "fmax_mhz", 0.15},
                                                                   {"power_mw", "power_mw", 0.15}}) {
      const double expected = whole[theirs].get<double>();
      EXPECT_NEAR(estimate[ours].get<double>(), expected, share * expected) << words << ": " << ours;
    }
  }
}

}  // namespace
}  // namespace mote::testing

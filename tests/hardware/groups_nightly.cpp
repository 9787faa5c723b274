#include <gtest/gtest.h>

#include "mote/hardware/filters/groups.hpp"
#include "tests/hardware/accuracy.hpp"

namespace mote::hardware {
namespace {

constexpr std::uint32_t kParticles = 256;
constexpr unsigned kGroups = 8;
constexpr std::size_t kRecordings = 1000;

/// Errors to the exact means on recordings of the growth model, one filter after the other on each.
struct Errors {
  std::vector<double> alone, single;           ///< groups without exchange, one filter of all particles
  std::vector<std::vector<double>> exchanged;  ///< groups that exchange 1, 2, 4 ... children
};

Errors errors() {
  const Ungm<1> model;
  const Subject growth = subject("growth", *catalogue_model("ungm"));
  const auto solver = referee::solver_of(model);
  Errors all;
  for (std::uint64_t seed = 1; seed <= kRecordings; ++seed) {
    Recording recording = statistics::simulate(model, 50, seed).recording;
    recording.observations = model.columns();
    const auto exact = solver->solve(recording).value().means;
    const auto error_of_groups = [&](std::uint32_t exchange) {
      Groups groups(growth.datapath.arithmetic, seed, 0, kGroups);
      groups.start(kParticles, exchange);
      return distance(golden_means(groups, growth, recording), exact);
    };
    Sisr sisr(growth.datapath.arithmetic, seed);
    sisr.start(kParticles);
    all.single.push_back(distance(golden_means(sisr, growth, recording), exact));
    all.alone.push_back(error_of_groups(0));
    all.exchanged.resize(4);
    for (std::size_t k = 0; k < all.exchanged.size(); ++k) all.exchanged[k].push_back(error_of_groups(1U << k));
  }
  return all;
}

// claim    one child of 32 that goes round the ring wins back half of what groups of 32 lose against one filter of 256
// referee  the point-mass filter
// design   1000 recordings of 50 steps, 8 groups, seeds 1 .. 1000, fixed; geometric means of ratios of errors
// risk     none: fixed seeds; the standard error of a ratio is about 0.01. The twin, groups alone, must be caught
TEST(GroupsNightly, WinBackByExchangeWhatTheyLoseAlone) {
  const Errors all = errors();
  const Paired alone{all.alone, all.single};
  print("groups alone over one filter", alone);
  for (std::size_t k = 0; k < all.exchanged.size(); ++k)
    print(("groups that exchange " + std::to_string(1 << k)).c_str(), Paired{all.exchanged[k], all.single});
  const double lost = alone.ratio().first - 1;
  EXPECT_LT(Paired(all.exchanged[0], all.single).ratio().first - 1, lost / 2);
  EXPECT_GT(lost, 0.1) << "the twin";
}

}  // namespace
}  // namespace mote::hardware

// Circuits of chains: what overlapped steps save and cost, and how pairs with another proposal filter.

#include <gtest/gtest.h>

#include "tests/hardware/accuracy.hpp"

namespace mote::hardware {
namespace {

/// The error of IMH with overlapped steps, and of IMH whose parents are swept in the order of the chain, over IMH's.
struct Overlap {
  Paired overlapped, swept;
};

/// Parents in the order in which the chain left them, whatever the filter chose.
Arithmetic sweeping(Arithmetic arithmetic, const Imh* const& filter) {
  arithmetic.propose = [full = arithmetic.propose, &filter](unsigned t, Observed y, const Particles& parents,
                                                            const WordColumns& words, Particles& states) {
    Particles in_order = parents;
    for (std::size_t d = 0; d < parents.size(); ++d)
      for (std::size_t j = 0; j < parents[d].size(); ++j)
        in_order[d][j] = filter->set()[d][j % filter->set()[d].size()];
    full(t, y, in_order, words, states);
  };
  return arithmetic;
}

Overlap overlap(std::uint32_t particles, std::size_t recordings) {
  const Ungm<1> model;
  const Subject growth = subject("growth", *catalogue_model("ungm"), {.overlapped = true});
  const auto solver = referee::solver_of(model);
  Overlap all;
  for (std::uint64_t seed = 1; seed <= recordings; ++seed) {
    Recording recording = statistics::simulate(model, 50, seed).recording;
    recording.observations = model.columns();
    const auto exact = solver->solve(recording).value().means;
    const auto error = [&](Imh& filter) {
      filter.start({particles, particles, 0, false});
      return distance(golden_means(filter, growth, recording), exact);
    };
    Imh apart(growth.datapath.arithmetic, seed);
    Imh overlapped(growth.datapath.arithmetic, seed + 1'000'000, 0, {.overlapped = true});
    const Imh* that = nullptr;
    Imh swept(sweeping(growth.datapath.arithmetic, that), seed + 2'000'000);
    that = &swept;
    const double reference = error(apart);
    all.overlapped.circuit.push_back(error(overlapped));
    all.swept.circuit.push_back(error(swept));
    all.overlapped.software.push_back(reference);
    all.swept.software.push_back(reference);
    if (seed == 1)
      std::printf("N = %u, 50 steps: %lu cycles, overlapped %lu\n", particles,
                  static_cast<unsigned long>(apart.cycles()), static_cast<unsigned long>(overlapped.cycles()));
  }
  return all;
}

void expect_no_cost(std::uint32_t particles, std::size_t recordings, bool told_apart) {
  const Overlap found = overlap(particles, recordings);
  for (const auto& [what, paired] : {std::pair{"overlapped", &found.overlapped}, std::pair{"swept", &found.swept}})
    std::printf("%s: error over that of steps apart: %.4f +- %.4f\n", what, paired->ratio().first,
                paired->ratio().second);
  const auto [ratio, error] = found.overlapped.ratio();
  EXPECT_LE(ratio, 1.02 + 2 * error);
  if (told_apart) {
    EXPECT_GT(found.swept.ratio().first, 1.06) << "the twin";
  }
}

// claim    overlapped steps cost no accuracy: parents among those that have emerged are as good as among all
// referee  the same filter apart, by its error to the exact means; other seeds, so that the two err independently
// design   growth model, N = 1000 and 100 (where half of the slots are withheld from the first rows), fixed seeds
// risk     none: fixed seeds. The twin sweeps the parents in the chain's order, which would overlap as well
TEST(OverlappedStepsNightly, CostNoAccuracyAtAThousand) { expect_no_cost(1000, 1500, true); }
TEST(OverlappedStepsNightly, CostNoAccuracyAtAHundred) { expect_no_cost(100, 3000, false); }

// claim    a circuit of pairs filters as well as the double filter of pairs, by a proposal that looks at the
// observation referee  the point-mass filter; the double filter by the same proposal design   growth model, N = 1000,
// 300 recordings of 50 steps, fixed seeds risk     none: fixed seeds; the standard error of a ratio is about 0.03. The
// twin has log weights four times as large
TEST(PairsNightly, FilterAsWellAsTheDoubleFilter) {
  const Ungm<1> model;
  const WordStudy study(*catalogue_model("ungm"),
                        {.particles = 200, .steps = 40, .recordings = 4, .proposal = "observation", .search = {}});
  const Subject pairs{"pairs", study.recorded(), {}, datapath(study.recorded(), study.samples(), {})};
  Arithmetic sharpened = pairs.datapath.arithmetic;
  sharpened.weigh = [full = sharpened.weigh](unsigned t, Observed y, const Particles& x,
                                             std::span<std::int64_t> log_weights) {
    full(t, y, x, log_weights);
    for (std::int64_t& log_weight : log_weights) log_weight = std::max<std::int64_t>(4 * log_weight, -(1 << 23));
  };
  const auto solver = referee::solver_of(model);
  Paired right, twin;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Recording recording = statistics::simulate(model, 50, seed).recording;
    recording.observations = model.columns();
    const auto exact = solver->solve(recording).value().means;
    const auto software = make_auxiliary<double, UngmObservation>(model, 1000, seed);
    const double reference = distance(double_means(*software, 1, recording), exact);
    const auto add = [&](Paired& paired, const Arithmetic& arithmetic) {
      Imh filter(arithmetic, seed);
      filter.start({1000, 1000, 0, false});
      paired.circuit.push_back(distance(golden_means(filter, pairs, recording), exact));
      paired.software.push_back(reference);
    };
    add(right, pairs.datapath.arithmetic);
    add(twin, sharpened);
  }
  print("auxiliary, observation", right);
  print("its twin", twin);
  EXPECT_LE(right.ratio().first, 1.06);
  EXPECT_GT(twin.ratio().first, 1.06) << "the twin";
}

}  // namespace
}  // namespace mote::hardware

#include "mote/hardware/filters/imh.hpp"

#include <gtest/gtest.h>

#include "mote/engine/latency.hpp"
#include "mote/hardware/filters/cosim/models.hpp"

namespace mote::hardware {
namespace {

const std::vector<std::int64_t> kObserved{32 * 1100};

Imh started(const ImhRegisters& registers) {
  Imh filter(cosim::local_level(), 1);
  filter.start(registers);
  return filter;
}

TEST(Imh, StepsByTheLatencyLaw) {
  for (const ImhRegisters& r : {ImhRegisters{100, 100, 0}, ImhRegisters{100, 100, 30}, ImhRegisters{100, 300, 30}}) {
    Imh filter = started(r);
    filter.step(kObserved);
    const std::uint64_t begun = filter.begun();
    filter.step(kObserved);
    const double law = sequential_time(r.draws + r.burn_in, {1, 1, 1}, {8, 5});
    EXPECT_EQ(static_cast<double>(filter.begun() - begun), law);
  }
}

TEST(Imh, KeepsOnlyStatesThatItProposed) {
  Imh filter = started({50, 50, 0});
  filter.step(kObserved);
  std::vector<std::int64_t> set = filter.set()[0];
  std::sort(set.begin(), set.end());
  const auto kinds = std::unique(set.begin(), set.end()) - set.begin();
  EXPECT_GT(kinds, 5);
  EXPECT_LT(kinds, 50) << "a chain that never stays is none";
}

TEST(Imh, AcceptsEveryProposalOfEqualWeight) {
  Arithmetic flat = cosim::local_level();
  flat.weigh = [](unsigned, Observed, const Particles&, std::span<std::int64_t> log_weights) {
    std::fill(log_weights.begin(), log_weights.end(), -5000);
  };
  Imh filter(flat, 1);
  filter.start({100, 100, 20});
  EXPECT_EQ(filter.step(kObserved).accepted, 119U);
}

TEST(Imh, TellsTheEvidenceOfAFarObservation) {
  Arithmetic far = cosim::local_level();
  far.weigh = [](unsigned, Observed, const Particles&, std::span<std::int64_t> log_weights) {
    std::fill(log_weights.begin(), log_weights.end(), -1024 * 5000);
  };
  Imh filter(far, 1);
  filter.start({100, 100, 0});
  EXPECT_NEAR(log2_evidence(filter.step(kObserved), far.formats, 100), -5000, 1e-9);
}

}  // namespace
}  // namespace mote::hardware

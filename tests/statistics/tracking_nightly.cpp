#include <gtest/gtest.h>

#include "tests/statistics/tracking.hpp"

namespace mote::statistics {
namespace {

// claim    200 000 particles give MIXED's posterior means: every step's x and y within 0.02 m (IMH 0.03) of a
//          million's, velocities within 0.001 m/s
// referee  SISR with 1 000 000 particles
// design   24 steps in both cases, one run each, fixed seeds
// risk     the measured distances are a tenth of the bounds; the twin (the start of y 0.05 m off) must be caught
TEST(TrackingNightly, LargeFiltersAgreeOnMixedsCases) {
  for (const double degrees : {0.29, 2.8}) {
    const Bearings model = mixed_case(degrees);
    const Recording recording = mixed_recording(degrees);
    const auto traced = [&](const std::unique_ptr<Filter>& filter) {
      return trace(*filter, model.states(), recording);
    };
    const Trace reference = traced(make_sisr(model, 1000000, 1));
    const auto within = [&](const std::string& name, const Trace& got, double bound) {
      bool near = true;
      for (std::size_t d = 0; d < 4; ++d) {
        const double distance = largest_distance(got, reference, d);
        measured("bearings, sigma_r = " + std::to_string(degrees).substr(0, 4) + " deg, " + name +
                     ", largest distance of " + model.states()[d].name,
                 distance, 0);
        near = near && distance < (d % 2 == 0 ? bound : 0.001);
      }
      return near;
    };
    EXPECT_TRUE(within("sisr, N = 200 000", traced(make_sisr(model, 200000, 2)), 0.02));
    EXPECT_TRUE(within("imh, N = 200 000", traced(make_imh(model, 200000, 3)), 0.03));
    EXPECT_TRUE(within("imh improved, N = 200 000", traced(make_imh(model, 200000, 4, improved())), 0.03));
    Bearings moved = model;
    moved.p.y0 += 0.05;
    EXPECT_FALSE(within("twin: start moved", traced(make_sisr(moved, 200000, 5)), 0.02));
  }
}

}  // namespace
}  // namespace mote::statistics

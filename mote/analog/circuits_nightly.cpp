// Circuits at the ends of what is not refused.

#include <gtest/gtest.h>

#include "mote/analog/simulation.hpp"

namespace mote::analog {
namespace {

// claim    whatever refuse_absurd() lets through has a solution that is the circuit's: no refusal, y within 0.5
TEST(CircuitsNightly, WorkWhereTheyAreNotRefused) {
  for (const Function function : {Function::kArctan, Function::kGaussian})
    for (const double ia_a : {1e-11, 1e-10, 1e-9, 1e-8, 1e-7})
      for (const double temperature_c : {-40.0, 27.0, 125.0})
        for (const double supply_v : {2.5, 3.0, 5.5}) {
          const Setting setting{Level::kRealistic, ia_a, {.temperature_c = temperature_c, .supply_v = supply_v}};
          EXPECT_NO_THROW(swept(translinear(function), setting, 25))
              << name_of(function) << " " << ia_a << " A " << temperature_c << " C " << supply_v << " V";
        }
}

}  // namespace
}  // namespace mote::analog

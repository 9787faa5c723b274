#pragma once
// For tests that simulate: they are left out where ngspice is not installed.

#include <string>

#include "mote/analog/spice.hpp"
#include "mote/base/refusal.hpp"

namespace mote::analog {

/// Why nothing can be simulated; empty if it can.
inline std::string spice_missing() {
  try {
    Spice::loaded();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

}  // namespace mote::analog

#define MOTE_NEEDS_NGSPICE \
  if (const std::string why = mote::analog::spice_missing(); !why.empty()) GTEST_SKIP() << why

#pragma once
// For tests that simulate: they are left out where ngspice is not installed.

#include <string>

#include "mote/analog/spice.hpp"

#define MOTE_NEEDS_NGSPICE \
  if (const std::string why = mote::analog::Spice::missing(); !why.empty()) GTEST_SKIP() << why

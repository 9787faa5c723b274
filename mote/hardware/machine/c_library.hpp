#pragma once
/// The golden model of a circuit as a library in C, for hosts and tests that know nothing of mote.

#include <vector>

#include "mote/hardware/machine/machine.hpp"

namespace mote::hardware {

/// A folder's files: <name>.h and <name>.c with what they include, replay.c, which plays a testbench's recording with
/// the registers `played`, and run.sh, which builds it.
///
///   NAME_open() -> NAME_start(filter, registers) -> NAME_step(filter, observation, estimate), words as on the streams
///
/// shape   instance: what the names of the recording's files end with, of one circuit among several
std::vector<DesignFile> c_library(const Machine& machine, const RunRegisters& played, const std::string& instance = "");

}  // namespace mote::hardware

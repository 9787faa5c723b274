#pragma once
/// What a whole filter circuit takes of a device: area, clock, power.

#include <optional>
#include <string>

#include "mote/hardware/machine/machine.hpp"
#include "mote/hardware/synthesis.hpp"

namespace mote::hardware {

/// Device families that circuits are synthesised for.
enum class Family : std::uint8_t { kXc7, kIce40, kEcp5 };

struct Cost {
  std::string device;  ///< with its speed grade, and what the figures come from
  int lut = 0, ff = 0, dsp = 0;
  int bram18 = 0;  ///< blocks of 18 kbit; of others what they amount to
  std::optional<double> fmax_mhz;
  std::optional<double> power_mw;  ///< an estimate, see power_mw()
};

/// Synthesises a circuit (Yosys) and finds its clock: xc7 by the delays of the cells along the slowest path, wires
/// taken as kWireShare of it; ice40 by place and route of its blocks (pipelines and filter apart, the slowest counts);
/// ecp5: cells alone, no clock.
///
/// error   Refusal (kOutsideTool) when yosys or nextpnr-ice40 is missing or fails
/// cost    20 to 300 s
Cost cost_of(const Machine& machine, Family family);

/// Power of a 7-series device that is busy all the time: an estimate, not a measurement.
///
///   P = P_0 + f (LUT p_l + FF p_f + DSP p_d + BRAM18 p_b),   P_0 = 82 mW
///
/// with 0.04, 0.015, 20 and 20 uW/MHz: what the vendor's spreadsheet gives about for one bit in eight changing a clock
double power_mw(const Area& area, double mhz);

}  // namespace mote::hardware

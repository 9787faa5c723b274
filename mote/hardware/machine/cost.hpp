#pragma once
/// What a whole filter circuit takes of a device: area, clock, power.

#include <optional>
#include <string>

#include "mote/hardware/machine/accelerator.hpp"
#include "mote/hardware/machine/activity.hpp"
#include "mote/hardware/machine/machine.hpp"
#include "mote/hardware/synthesis.hpp"

namespace mote::hardware {

/// Device families that circuits are synthesised for.
enum class Family : std::uint8_t { kXc7, kIce40, kEcp5 };

struct Cost {
  std::string device;  ///< with its speed grade, and what the figures come from
  int lut = 0, ff = 0, dsp = 0;
  int bram18 = 0;  ///< blocks of 18 kbit; of others what they amount to
  int iob = 0;     ///< pins that all ports together take
  std::optional<double> fmax_mhz = {};
  std::optional<double> sta_ns = {};    ///< slowest path by Yosys's own timing, where a Yosys that has it is found
  std::string no_sta = {};              ///< why that is not known, where it was sought
  std::optional<double> power_mw = {};  ///< an estimate, see power_mw()
};

/// Synthesises a circuit (Yosys) and finds its clock: xc7 by the delays of the cells along the slowest path, wires
/// taken as kWireShare of it, and with_sta, side by side, by sta_ns(); ice40 by place and route of its blocks
/// (pipelines and filter apart, the slowest counts); ecp5 by place and route of the whole where nextpnr-ecp5 is on
/// PATH, else without a clock.
///
/// error   Refusal (kOutsideTool) when yosys or nextpnr-ice40 is missing or one of the programs fails
/// cost    20 to 300 s
Cost cost_of(const Machine& machine, Family family, const Activity& activity = {}, bool with_sta = true);

/// The slowest path of a circuit on xc7 by the command sta of a newer Yosys (newer_yosys.hpp); nothing where there is
/// none.
///
/// error   Refusal (kOutsideTool) when it fails
/// cost    20 to 100 s
std::optional<double> sta_ns(const Machine& machine);

/// The same of an accelerator on xc7.
Cost cost_of(const Accelerator& accelerator);

/// The filter alone, the model's pipelines cut off: with them, one of each a lane, it is the machine.
Circuit filter_alone(const Machine& machine);

/// A part of a circuit, synthesised by itself on xc7.
struct PartCost {
  Area area;
  double path_ns = 0;  ///< its slowest path from register to register, cells only
  /// Of paths that go on in other parts: the beginning of the slowest that leaves, the end of the slowest that comes
  /// in. A filter's are those to and from proposals.
  double leaving_ns = 0, coming_ns = 0;
  double log_ns = 0;  ///< of a filter: the end of paths that come in with log weights
};

/// error   Refusal (kOutsideTool) when yosys is missing or fails
/// cost    1 to 20 s
PartCost part_cost(const Circuit& circuit);

/// What a machine takes by its parts: the sum of their areas, pipelines once a lane, and the slowest of their paths and
/// of those from one into the next; on xc7. What is shared, or cut short, where parts meet is not seen.
Cost cost_of_parts(const Machine& machine, const PartCost& propose, const PartCost& weigh, const PartCost& filter);

/// Power of a 7-series device that is busy all the time: an estimate, not a measurement.
///
///   P = P_0 + f (a_f / a_0 (LUT p_l + FF p_f) + a_p / a_0 DSP p_d + BRAM18 p_b),   P_0 = 82 mW,  a_0 = 1/8
///
/// with 0.04, 0.015, 20 and 20 uW/MHz: what the vendor's spreadsheet gives about for one bit in eight changing a clock;
/// a_f, a_p are the activity's shares. A memory block takes the same whenever it is read, which is every clock.
double power_mw(const Area& area, double mhz, const Activity& activity = {});

}  // namespace mote::hardware

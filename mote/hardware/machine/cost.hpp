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

/// A part of a machine, or a whole one, synthesised by itself on xc7.
struct PartCost {
  Area area;
  double path_ns = 0;  ///< its slowest path from register to register, cells only
};

/// error   Refusal (kOutsideTool) when yosys is missing or fails
/// cost    a pipeline: 1 to 20 s; a machine: 20 to 60 s
PartCost part_cost(const Circuit& circuit);
PartCost part_cost(const Machine& machine);

/// A model's two pipelines.
struct PipelineCosts {
  PartCost propose, weigh;
};

/// What a machine takes on xc7 by another one, the anchor, of its kind and lanes: its own pipelines stand in place of
/// the anchor's, once a lane. Its clock is the anchor's, or that of a pipeline of its own that is slower: where
/// pipelines and filter meet it is taken to be as the anchor.
///
/// cost    none: no tool is called
Cost cost_of_parts(const PartCost& anchor, unsigned lanes, const PipelineCosts& anchors, const PipelineCosts& own);

/// Power of a 7-series device that is busy all the time: an estimate, not a measurement.
///
///   P = P_0 + f (a_f / a_0 (LUT p_l + FF p_f) + a_p / a_0 DSP p_d + BRAM18 p_b),   P_0 = 82 mW,  a_0 = 1/8
///
/// with 0.04, 0.015, 20 and 20 uW/MHz: what the vendor's spreadsheet gives about for one bit in eight changing a clock;
/// a_f, a_p are the activity's shares. A memory block takes the same whenever it is read, which is every clock.
double power_mw(const Area& area, double mhz, const Activity& activity = {});

}  // namespace mote::hardware

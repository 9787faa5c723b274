#pragma once
/// What a circuit costs: area by Yosys, clock rate by place and route.

#include <map>
#include <string>
#include <vector>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// Cells of a Xilinx 7-series device after synthesis, without input and output buffers.
struct Area {
  int lut = 0;  ///< all look-up tables, those that hold memory or shift registers too
  int ff = 0;
  int dsp = 0;     ///< DSP48E1
  int bram18 = 0;  ///< RAMB18E1 + 2 RAMB36E1
};

/// Synthesises a circuit by itself (Yosys, synth_xilinx -family xc7).
///
/// error   Refusal (kOutsideTool) when yosys is missing or fails
/// cost    1 to 20 s
Area xc7_area(const Circuit& circuit);

/// The number of cells of each kind that a Yosys script leaves of the modules in a folder (with its closing slash).
///
/// error   Refusal (kOutsideTool) when yosys is missing or fails
std::map<std::string, int> cells_after(const std::string& folder, const std::string& script);

/// What Yosys does for a Xilinx 7-series device; the inverters that it leaves at each flip-flop's reset become one.
std::string xc7_script(const std::string& top);

/// How many cells are of kinds with these beginnings.
int total(const std::map<std::string, int>& cells, const std::vector<std::string>& beginnings);

/// The area of those of synth_xilinx.
Area xc7_area(const std::map<std::string, int>& cells);

/// A circuit placed and routed between shift registers.
struct Routed {
  int luts = 0;  ///< look-up tables of the circuit and its surroundings
  double mhz = 0;
};

/// On an iCE40 HX8K, which has no DSP blocks: products are logic.
///
/// error   Refusal (kOutsideTool) when yosys or nextpnr-ice40 is missing or fails (a circuit that is too large)
/// cost    5 to 60 s
Routed ice40_routed(const Circuit& circuit, int seed = 1);

/// On an ECP5-25F of speed grade 6, by nextpnr-ecp5, which Debian 12 has no package of.
Routed ecp5_routed(const Circuit& circuit, int seed = 1);

}  // namespace mote::hardware

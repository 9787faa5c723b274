#pragma once
/// When signals arrive: static timing of a netlist of Xilinx 7-series cells, wires left out.

#include <string>

namespace mote::hardware {

/// A path from a clock edge to the next, through cells.
struct SlowestPath {
  double ns = 0;      ///< arrival and set-up, cells only
  std::string cells;  ///< their kinds along it, the first one's clock first
};

/// The slowest path of a netlist after synth_xilinx -flatten.
///
/// shape   json: what Yosys's write_json gives; top: its only module that has cells
/// error   Refusal (kOutsideTool): the netlist has no such module
/// cost    O(cells + wires)
/// source  delays of Artix-7, speed grade -1, as Project X-Ray measured them from the vendor's timing files
SlowestPath slowest_path(const std::string& json, const std::string& top);

}  // namespace mote::hardware

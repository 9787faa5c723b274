#pragma once
/// Delays of Xilinx 7-series cells, ps.
///
/// source  Artix-7, speed grade -1, Project X-Ray's timing files as Yosys 0.23 carries them (xilinx/cells_sim.v)

#include <map>
#include <optional>
#include <string>

namespace mote::hardware {

/// Parameters of a cell that are numbers.
using CellParameters = std::map<std::string, int>;

/// From an input to an output of a cell; nothing when no signal goes through.
std::optional<int> through_delay(const std::string& kind, const CellParameters& parameters, const std::string& input,
                                 std::size_t input_bit, const std::string& output, std::size_t output_bit);

/// From the clock's edge to an output; nothing for cells without a register before it.
std::optional<int> arrival_delay(const std::string& kind, const CellParameters& parameters, const std::string& output);

/// Before the clock's edge at an input; nothing for cells without a register behind it.
std::optional<int> setup_time(const std::string& kind, const CellParameters& parameters, const std::string& input);

}  // namespace mote::hardware

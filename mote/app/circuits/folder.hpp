#pragma once
/// The folder of a design: what a board needs, and what proves it.

#include <string>

#include "mote/app/circuits/report.hpp"
#include "mote/app/files/output.hpp"

namespace mote {

/// Adds a design's files to the outputs: SystemVerilog, tables, constraints, a script for Vivado, a testbench that
/// plays a recording, a README.
///
/// error   Refusal (kCannotWrite) when the folder cannot be made, or holds files of those names that another program
///         wrote
void write_design(OutputSet& outputs, const std::string& folder, const FilterCircuit& circuit,
                  const CircuitReport& found, const Recording& played, const std::string& where);

}  // namespace mote

#pragma once
/// The folder of a design: what a board needs, and what proves it.

#include <map>
#include <string>

#include "mote/app/circuits/report.hpp"
#include "mote/app/files/output.hpp"

namespace mote {

/// Texts by their names in a folder.
using DesignFiles = std::map<std::string, std::string>;

/// Adds them to the outputs; circuit.json, one of them, is the mark of a folder that this program wrote.
///
/// error   Refusal (kCannotWrite) when the folder cannot be made, or holds files of those names that another program
///         wrote
void write_files(OutputSet& outputs, const std::string& folder, const DesignFiles& files);

/// A line of a testbench's file: words, the highest first.
std::string hex_of(const std::vector<std::uint32_t>& words);

/// Adds a design's files to the outputs: SystemVerilog, tables, constraints, a script for Vivado, a testbench that
/// plays a recording, the golden model in C, a README.
///
/// error   as write_files()
void write_design(OutputSet& outputs, const std::string& folder, const FilterCircuit& circuit,
                  const CircuitReport& found, const Recording& played, const std::string& where);

}  // namespace mote

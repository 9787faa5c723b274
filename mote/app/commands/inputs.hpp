#pragma once
/// What a command reads is not to be written over.

#include <string>
#include <vector>

#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"

namespace mote {

/// Keeps the outputs from the files that the command reads: those of `options`, text models of MODEL (one, or several
/// separated by commas), and those of `--set file=`.
void protect_inputs(OutputSet& outputs, const Arguments& arguments, const std::vector<std::string>& options);

}  // namespace mote

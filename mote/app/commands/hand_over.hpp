#pragma once
/// Handing words over to the program beside this one that has what they ask for.

#include <string>
#include <vector>

#include "mote/base/outside.hpp"

namespace mote {

/// The path of a program that lies beside this one.
std::string beside(const std::string& name);

/// Becomes the program mote-track, with the same words: it loads OpenCV, which costs a tenth of a second.
///
/// error   Refusal (kOutsideTool) when that program is not beside this one or does not start; else never returns
[[noreturn]] void hand_over_to_tracker(char** words);

/// Runs mote-track and waits for its end; words are those after its name.
///
/// error   Refusal (kOutsideTool) when that program is not beside this one or does not start
OutsideEnd run_tracker(const std::vector<std::string>& words);

/// Becomes the program mote-mpi, which loads Open MPI.
///
/// error   as hand_over_to_tracker()
[[noreturn]] void hand_over_to_team(char** words);

}  // namespace mote

#pragma once
/// Handing words over to the program beside this one that has what they ask for.

namespace mote {

/// Becomes the program mote-track, with the same words: it loads OpenCV, which costs a tenth of a second.
///
/// error   Refusal (kOutsideTool) when that program is not beside this one or does not start; else never returns
[[noreturn]] void hand_over_to_tracker(char** words);

/// Becomes the program mote-mpi, which loads Open MPI.
///
/// error   as hand_over_to_tracker()
[[noreturn]] void hand_over_to_team(char** words);

}  // namespace mote

#pragma once
/// Programs that do a part of the work and say what they found.

#include <string>
#include <vector>

namespace mote {

/// How a program ended.
struct OutsideEnd {
  int error = 0;                   ///< errno of a program that did not start; then nothing else is known
  int code = 0;                    ///< its exit code; 128 and the signal's number when a signal ended it
  std::string out = {}, err = {};  ///< what it told standard output and standard error
};

/// Runs a program, sought in PATH where its name has no slash, with nothing to read, and waits for its end.
///
/// shape   words: those after its name
OutsideEnd run_outside(const std::string& program, const std::vector<std::string>& words);

}  // namespace mote

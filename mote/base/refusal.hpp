#pragma once
/// Refusals: the one sentence a user gets for wrong use or bad input, and the exit code that goes with it.

#include <stdexcept>
#include <string>

namespace mote {

/// What a program that refuses returns to its caller (the fixed exit codes of the `mote` program).
enum class ExitCode : int {
  kDone = 0,
  kWrongUse = 2,       ///< an option, a model name, a value out of range
  kBadData = 3,        ///< a missing, empty or malformed input file
  kCollapsed = 4,      ///< every particle has weight zero and the policy is to stop
  kOutsideTool = 5,    ///< a program we call is missing or failed
  kCannotWrite = 6,    ///< an output could not be written
  kInterrupted = 130,  ///< Ctrl-C or SIGTERM ended the run
};

/// A refusal states five facts in one order: where, what, expected, got, next step.
struct RefusalText {
  std::string where;      ///< "mote run", "obs.csv:17"
  std::string what;       ///< "--particles", "column \"y\""
  std::string expected;   ///< "an integer from 1 to 268435456"
  std::string got;        ///< "0"
  std::string next_step;  ///< "Pass --particles 1000."
};

/// Thrown for misuse and bad input; statuses such as a collapsed filter are records, not exceptions.
class Refusal : public std::runtime_error {
 public:
  /// The sentence "where: what: expected E, got G. Next step."; empty facts are left out.
  Refusal(ExitCode code, const RefusalText& text);
  /// A free sentence, for the rare refusal without an expectation.
  Refusal(ExitCode code, const std::string& sentence);

  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace mote

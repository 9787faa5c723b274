#pragma once
/// ngspice, the circuit simulator, through its shared library: circuits go in as lines, results come out as numbers.

#include <string>
#include <vector>

namespace mote::analog {

/// The simulator. There is one in a process, for ngspice keeps its circuit in global variables: not for several
/// threads.
class Spice {
 public:
  /// Loads ngspice on first use, some milliseconds.
  ///
  /// error   Refusal (kOutsideTool) naming the package when it is not installed, or was not when mote was built
  static Spice& loaded();

  /// Why there is none, in a sentence; empty if there is.
  static std::string missing();

  /// Takes a circuit in place of the one before, whose results go.
  ///
  /// shape   lines: without the closing ".end"
  /// error   Refusal (kOutsideTool) with what ngspice said
  void take(std::vector<std::string> lines);
  /// Runs a command: "dc iin 0 1e-7 1e-9". Its results replace those before.
  ///
  /// error   Refusal (kOutsideTool) with what ngspice said, when it found no solution
  void run(const std::string& command);
  /// The results under a name: "v(out)", "vdd#branch", "@bunit[i]"; "time" in a transient.
  ///
  /// error   Refusal (kOutsideTool) when there are none
  std::vector<double> values(const std::string& name) const;

  /// A library of another name in place of ngspice's.
  explicit Spice(const std::string& library);

 private:
  static int heard(char* text, int, void* self);
  static int ended(int code, bool immediately, bool by_quit, int, void* self);
  void command(const std::string& text);
  [[noreturn]] void fail(const std::string& what) const;

  void* library_ = nullptr;
  std::string said_;  ///< since the last command
  bool over_ = false;
  bool taken_ = false;
};

}  // namespace mote::analog

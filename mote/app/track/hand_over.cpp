#include "mote/app/track/hand_over.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "mote/base/refusal.hpp"

namespace mote {

namespace {

[[noreturn]] void hand_over(const std::string& name, const std::string& meaning, char** words) {
  std::error_code unknown;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = (here.parent_path() / name).string();
  execv(program.c_str(), words);
  throw Refusal(ExitCode::kOutsideTool, {"mote", program, meaning + ", beside mote", std::strerror(errno),
                                         "Build or install it together with mote."});
}

}  // namespace

void hand_over_to_tracker(char** words) { hand_over("mote-track", "the program that tracks", words); }

void hand_over_to_team(char** words) { hand_over("mote-mpi", "the program that runs on several processes", words); }

}  // namespace mote

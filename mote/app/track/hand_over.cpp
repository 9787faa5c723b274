#include "mote/app/track/hand_over.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "mote/base/refusal.hpp"

namespace mote {

void hand_over_to_tracker(char** words) {
  std::error_code unknown;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = (here.parent_path() / "mote-track").string();
  execv(program.c_str(), words);
  throw Refusal(ExitCode::kOutsideTool, {"mote", program, "the program that tracks, beside mote", std::strerror(errno),
                                         "Build or install it together with mote."});
}

}  // namespace mote

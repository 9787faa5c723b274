#include "mote/app/commands/hand_over.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

/// The refusal of a program that does not start.
Refusal not_started(const std::string& program, const std::string& meaning, int error) {
  return {
      ExitCode::kOutsideTool,
      {"mote", program, meaning + ", beside mote", std::strerror(error), "Build or install it together with mote."}};
}

[[noreturn]] void hand_over(const std::string& name, const std::string& meaning, char** words) {
  const std::string program = beside(name);
  execv(program.c_str(), words);
  throw not_started(program, meaning, errno);
}

constexpr const char* kTracker = "mote-track";
constexpr const char* kTracks = "the program that tracks";

}  // namespace

std::string beside(const std::string& name) {
  std::error_code unknown;
  return (std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / name).string();
}

void hand_over_to_tracker(char** words) { hand_over(kTracker, kTracks, words); }

void hand_over_to_team(char** words) { hand_over("mote-mpi", "the program that runs on several processes", words); }

OutsideEnd run_tracker(const std::vector<std::string>& words) {
  const std::string program = beside(kTracker);
  OutsideEnd end = run_outside(program, words);
  if (end.error != 0) throw not_started(program, kTracks, end.error);
  return end;
}

}  // namespace mote

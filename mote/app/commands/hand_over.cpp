#include "mote/app/commands/hand_over.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

/// A program that lies beside this one.
std::string beside(const std::string& name) {
  std::error_code unknown;
  return (std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / name).string();
}

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

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string text_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

/// Starts the program with nothing to read, its words to nobody and its complaints in a file.
pid_t started(const std::vector<std::string>& words, int complaints) {
  const std::string program = beside(kTracker);
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&streams, complaints, STDERR_FILENO);
  pid_t child = -1;
  const int error = posix_spawn(&child, program.c_str(), &streams, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0) throw not_started(program, kTracks, error);
  return child;
}

}  // namespace

void hand_over_to_tracker(char** words) { hand_over(kTracker, kTracks, words); }

void hand_over_to_team(char** words) { hand_over("mote-mpi", "the program that runs on several processes", words); }

TrackerEnd run_tracker(const std::vector<std::string>& words) {
  const File complaints(std::tmpfile(), std::fclose);
  if (complaints == nullptr) throw not_started(beside(kTracker), kTracks, errno);
  const pid_t child = started(words, fileno(complaints.get()));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(complaints.get())};
}

}  // namespace mote

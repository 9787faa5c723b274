#pragma once
/// Runs the built program as a user does: a child process in a folder of its own.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mote/base/scratch_folder.hpp"

namespace mote::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kMemoryIsMoteOwn = false;  // the sanitizers' shadow is many times the program's
#else
inline constexpr bool kMemoryIsMoteOwn = true;
#endif

/// Whether simulated clusters were built: SimGrid was there.
#ifdef MOTE_SIMULATES
inline constexpr bool kSimulates = true;
#else
inline constexpr bool kSimulates = false;
#endif

/// What a run of the program left.
struct Ended {
  int code = -1;
  std::string out, err;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A scratch folder that goes with the test, and a shell in it.
class Scratch : public ScratchFolder {
 public:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const { return slurp(path() / name); }

  /// Runs a shell line in the folder; `mote` is the program under test.
  Ended shell(const std::string& line) const {
    const std::string whole = "cd '" + path().string() + "' && mote() { '" MOTE_PROGRAM "' \"$@\"; } && ( " + line +
                              " ) >.out 2>.err </dev/null";
    const int status = std::system(whole.c_str());
    Ended ended{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(".out"), read(".err")};
    std::filesystem::remove(path() / ".out");
    std::filesystem::remove(path() / ".err");
    return ended;
  }

  /// Names of the files in the folder, sorted.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path()))
      if (entry.is_regular_file()) all[entry.path().filename().string()] = slurp(entry.path());
    return all;
  }
};

/// The program, or another one that starts it, as a child that is watched while it runs; standard error goes to the
/// file "err" of the folder.
class Child {
 public:
  Child(const Scratch& scratch, std::vector<std::string> words, const std::string& program = MOTE_PROGRAM)
      : scratch_(scratch), id_(fork()) {
    if (id_ < 0) throw std::runtime_error("fork failed");
    if (id_ > 0) return;
    if (chdir(scratch.path().c_str()) != 0) _exit(99);
    dup2(open("/dev/null", O_RDWR | O_CLOEXEC), STDOUT_FILENO);
    dup2(open("err", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600), STDERR_FILENO);
    words.insert(words.begin(), program);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execvp(program.c_str(), pointers.data());
    _exit(99);
  }

  /// Nothing when there is no such child: kill(-1) would mean every process.
  void signal(int number) const {
    if (id_ > 0) kill(id_, number);
  }

  pid_t id() const { return id_; }

  /// Waits for the end: exit code (128 + signal when one ended it), standard error, largest resident memory in bytes.
  struct End {
    int code;
    std::string err;
    double peak_bytes;
  };
  End end() {
    int status = 0;
    rusage usage{};
    wait4(id_, &status, 0, &usage);
    id_ = -1;
    End end{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), scratch_.read("err"),
            static_cast<double>(usage.ru_maxrss) * 1024};
    std::filesystem::remove(scratch_.path() / "err");
    return end;
  }

 private:
  const Scratch& scratch_;
  pid_t id_;
};

}  // namespace mote::testing

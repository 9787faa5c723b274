// numpy_filter.py in a process of its own, which times itself.
//
// Every operation on arrays is a pass that reads its operands and writes its result: 49 of 8 bytes a particle-step
// (propagate 21, log weights 9, weights 7, mean 2, resample 10).

#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/contenders/contender.hpp"
#include "bench/contenders/numpy_script.hpp"

namespace mote::contenders {
namespace {

struct Closed {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closed>;

/// A file without a name, open for reading and writing.
File scratch_file() {
  File file(std::tmpfile());
  if (!file) throw std::runtime_error("no temporary file can be made; check TMPDIR and the disk");
  return file;
}

/// Runs `python3 -c script words...` between two files; returns its exit code, -1 when there is no python3.
int run_python(const std::string& script, const std::string& first, const std::string& second, std::FILE* input,
               std::FILE* output) {
  std::array<std::string, 5> words{"python3", "-c", script, first, second};
  std::array<char*, 6> pointers{};
  for (std::size_t i = 0; i < words.size(); ++i) pointers[i] = words[i].data();
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, fileno(output), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "python3", &streams, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (failed != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class Numpy final : public Contender {
 public:
  void prepare(std::size_t particles, std::uint64_t seed) override {
    particles_ = std::to_string(particles);
    seed_ = std::to_string(seed);
  }

  void run(std::span<const double> observations, std::span<double> means) override {
    const File input = scratch_file();
    const File output = scratch_file();
    for (const double y : observations) std::fprintf(input.get(), "%.17g\n", y);
    std::rewind(input.get());
    const int code = run_python(numpy_script(), particles_, seed_, input.get(), output.get());
    if (code != 0) throw std::runtime_error("python3 ended with exit code " + std::to_string(code));
    std::rewind(output.get());
    seconds_ = number_from(output.get());
    bytes_ = number_from(output.get());
    for (double& mean : means) mean = number_from(output.get());
  }

  double outside_seconds() const override { return seconds_; }
  double outside_bytes() const override { return bytes_; }

 private:
  static double number_from(std::FILE* file) {
    double value = 0;
    if (std::fscanf(file, "%lf", &value) != 1) throw std::runtime_error("python3 wrote fewer numbers than it should");
    return value;
  }

  std::string particles_, seed_;
  double seconds_ = std::numeric_limits<double>::quiet_NaN();
  double bytes_ = std::numeric_limits<double>::quiet_NaN();
};

std::string why_not() {
  const File nothing = scratch_file();
  return run_python("import numpy", "", "", nothing.get(), nothing.get()) == 0
             ? std::string()
             : "python3 with numpy is missing (Debian: apt-get install python3-numpy)";
}

}  // namespace

const Description kNumpy{"numpy", "whole arrays in Python, double", 49 * 8, why_not,
                         []() -> std::unique_ptr<Contender> { return std::make_unique<Numpy>(); }};

}  // namespace mote::contenders

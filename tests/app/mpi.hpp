#pragma once
/// Jobs of mpirun, as tests start and watch them.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace mote::testing {

/// More ranks than cores, as root, in containers: what a test machine asks of Open MPI.
class Mpi : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const std::string name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                                   "OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_mpi_yield_when_idle"})
      setenv(name.c_str(), "1", 1);
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
  }

  void SetUp() override {
    if (!kMemoryIsMoteOwn) GTEST_SKIP() << "sanitizers find faults of Open MPI; teams of threads are tried under them";
  }

  Ended on(int ranks, const std::string& words) const {
    return scratch_.shell("mpirun -n " + std::to_string(ranks) + " '" MOTE_PROGRAM "' " + words);
  }
  /// A recording whose steps take a team some tenths of a second, and what one process makes of it.
  void prepare_steps(const std::string& options) const {
    ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --steps 2000 --out d.csv").code, 0);
    ASSERT_EQ(scratch_.shell("mote run bearings --data d.csv -n 20000 --out whole.csv --engine simd " + options).code,
              0);
  }
  /// The words of a run of it by a team that keeps checkpoints.
  static std::vector<std::string> steps_by_team(const std::vector<std::string>& options) {
    std::vector<std::string> words{"run",
                                   "bearings",
                                   "--data",
                                   "d.csv",
                                   "-n",
                                   "20000",
                                   "--out",
                                   "e.csv",
                                   "--engine",
                                   "mpi",
                                   "--checkpoint",
                                   "c",
                                   "--checkpoint-every",
                                   "100"};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  static int times(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  Scratch scratch_;
};

/// A job of mpirun that is watched.
class Job {
 public:
  Job(const Scratch& scratch, int ranks, const std::vector<std::string>& words)
      : child_(scratch, line(ranks, words), "mpirun") {
    const std::string id = std::to_string(child_.id());
    for (int i = 0; i < 200 && ranks_.size() < static_cast<std::size_t>(ranks); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::ifstream children("/proc/" + id + "/task/" + id + "/children");
      ranks_.assign(std::istream_iterator<pid_t>(children), {});
    }
  }
  /// Waits until a file is there: the job's first checkpoint, so that it is stepping.
  static bool has_written(const Scratch& scratch, const std::string& name) {
    for (int i = 0; i < 30000 && !std::filesystem::exists(scratch.path() / name); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::filesystem::exists(scratch.path() / name);
  }
  /// Sends a rank a signal after some time, if it has not ended by then.
  void signal_rank(std::size_t rank, int number, std::chrono::milliseconds after) const {
    std::this_thread::sleep_for(after);
    if (rank < ranks_.size()) kill(ranks_[rank], number);
  }
  std::size_t started() const { return ranks_.size(); }
  Child::End end() { return child_.end(); }

 private:
  static std::vector<std::string> line(int ranks, const std::vector<std::string>& words) {
    std::vector<std::string> all{"-n", std::to_string(ranks), MOTE_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }

  Child child_;
  std::vector<pid_t> ranks_;
};

}  // namespace mote::testing

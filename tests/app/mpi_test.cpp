// `mpirun -n R mote run --engine mpi`: the bytes of one process, refusals said once, lost ranks.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

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
  static int times(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  Scratch scratch_;
};

TEST_F(Mpi, GivesTheBytesOfOneProcess) {
  ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --steps 30 --out d.csv --truth t.csv").code, 0);
  for (const std::string options : {"-n 30001", "-n 8192 --precision float --ess-threshold 0.5 --proposal guided"}) {
    const std::string run = "run bearings --data d.csv --truth t.csv --out e.csv --summary s.json " + options;
    ASSERT_EQ(scratch_.shell("mote " + run + " --engine simd").code, 0);
    const std::string expected = scratch_.read("e.csv");
    for (const int ranks : {1, 2, 3, 5, 8}) {
      std::filesystem::remove(scratch_.path() / "e.csv");
      const Ended ended = on(ranks, run + " --engine mpi");
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_EQ(ended.err, "");
      EXPECT_EQ(scratch_.read("e.csv"), expected) << ranks << " ranks, " << options;
      EXPECT_EQ(times(ended.out, "mpi engine"), 1) << "rank 0 alone speaks: " << ended.out;
      EXPECT_EQ(scratch_.files().size(), 4U) << "and writes";
    }
  }
}

TEST_F(Mpi, IsATeamOfOneWithoutMpirun) {
  ASSERT_EQ(scratch_.shell("mote simulate ungm --steps 20 --out d.csv").code, 0);
  ASSERT_EQ(scratch_.shell("mote run ungm --data d.csv --out e.csv").code, 0);
  const Ended ended = scratch_.shell("mote run ungm --data d.csv --out m.csv --engine mpi");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(scratch_.read("m.csv"), scratch_.read("e.csv"));
}

/// As many ranks as a cast has, with its options.
struct Cast {
  int ranks;
  std::string options;
};

// claim    proposers, weighers and chains on ranks of their own give the bytes of the reference engine
TEST_F(Mpi, GivesTheBytesOfTheReferenceByStages) {
  ASSERT_EQ(scratch_.shell("mote simulate ungm --seed 3 --steps 4 --out d.csv").code, 0);
  for (const Cast& c : std::vector<Cast>{
           {3, "--filter sisr --proposers 1 --weighers 1"},
           {5, "--filter sisr --proposers 2 --weighers 2 --resampler residual"},
           {4, "--filter imh --proposers 1 --weighers 2 --burn-in 30"},
           {8, "--filter imh --proposers 3 --weighers 2 --chains 3 --draws 3000"},
           {5, "--filter auxiliary --proposers 1 --weighers 2 --chains 2 --parents permuted --chain-start weighted"}}) {
    const std::string run =
        "run ungm --data d.csv -n 2500 --estimate 'q0.9(x)' --out e.csv --dump-particles p.csv " + c.options;
    const std::string alone = run.substr(0, run.find(" --proposers")) + run.substr(run.find(" --weighers") + 13);
    ASSERT_EQ(scratch_.shell("mote " + alone + " --engine reference").code, 0) << alone;
    const auto expected = scratch_.files();
    std::filesystem::remove(scratch_.path() / "e.csv");
    std::filesystem::remove(scratch_.path() / "p.csv");
    const Ended ended = on(c.ranks, run + " --engine mpi");
    EXPECT_EQ(ended.code, 0) << c.options << "\n" << ended.err;
    EXPECT_EQ(scratch_.files(), expected) << c.options;
    EXPECT_EQ(times(ended.out, "mpi engine"), 1) << "rank 0 alone speaks: " << ended.out;
  }
}

struct Refusal {
  std::string words;
  int code;
  std::string sentence;
};

TEST_F(Mpi, RefusesOnceForAllRanks) {
  scratch_.write("d.csv", "t,y\n1,1100\n2,1000\n");
  scratch_.write("far.csv", "t,y\n1,1e300\n");
  const auto before = scratch_.files();
  const std::string run = "run local-level --data d.csv --out e.csv --engine mpi -n 9000 ";
  for (const Refusal& c : std::vector<Refusal>{
           {run + "-n 2048", 2, "at most 2 ranks for 2048 particles, a block of 1024 each, got 3 ranks. Start fewer"},
           {run + "--filter imh", 2, "--engine mpi: expected --filter sisr with --resampler systematic"},
           {run + "--resampler residual", 2, "--resampler residual --selection-exponent 1. Pass --engine fastest"},
           {run + "--filter imh --proposers 2", 2,
            "4 ranks: 2 that propose, 1 that weigh, 1 with a chain, got 3. Start"},
           {run + "--filter sqmc --weighers 1", 2, "--weighers: expected --filter sisr, imh or auxiliary, got"},
           {run + "--filter imh --burn-in auto --weighers 1", 2, "--burn-in auto, which waits for all weights"},
           {run + "--filter imh --data far.csv --weighers 1", 4, "t = 1: the filter collapsed"},
           {run + "--estimate 'P(level>0)'", 2, "--engine mpi: expected no --estimate beside it"},
           {run + "--dump-particles p.csv", 2, "--engine mpi: expected no --dump-particles beside it"},
           {run + "--checkpoint-every 3", 2, "--checkpoint-every: expected --checkpoint FILE beside it"},
           {run + "--checkpoint far.csv", 3, "far.csv: expected a checkpoint of mote run, got a file of another kind"},
           {run + "--proposal nope", 2, "--proposal: expected one of the model's proposals"},
           {run + "--data no.csv", 3, "no.csv: expected a file that can be read"},
           {run + "--data far.csv", 4, "t = 1: the filter collapsed"},
           {run + "--out no/e.csv", 6, "no/e.csv: expected an output that can be written"},
           {run + "--out /dev/full", 6, "/dev/full: expected an output that can be written"}}) {
    const Ended ended = on(3, c.words);
    EXPECT_EQ(ended.code, c.code) << c.words << "\n" << ended.err;
    EXPECT_EQ(times(ended.err, c.sentence), 1) << c.words << "\n" << ended.err;
    EXPECT_EQ(scratch_.files(), before) << c.words;
  }
  const Ended compare =
      scratch_.shell("mote compare local-level --filters 'sisr --engine mpi' -n 2000 --recordings 1 --repeats 1");
  EXPECT_EQ(compare.code, 2);
  EXPECT_NE(compare.err.find("--engine mpi"), std::string::npos) << compare.err;
}

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
  /// Kills a rank after some time, if it has not ended by then.
  void kill_rank(std::size_t rank, std::chrono::milliseconds after) const {
    std::this_thread::sleep_for(after);
    if (rank < ranks_.size()) kill(ranks_[rank], SIGKILL);
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

// Open MPI says which rank was lost, and ends the others.
TEST_F(Mpi, ALostRankEndsTheJob) {
  std::string data = "t,y\n";
  for (int t = 1; t <= 100000; ++t) data += std::to_string(t) + ",1000\n";
  scratch_.write("d.csv", data);
  Job job(scratch_, 3, {"run", "local-level", "--data", "d.csv", "--out", "e.csv", "-n", "100000", "--engine", "mpi"});
  ASSERT_EQ(job.started(), 3U);
  job.kill_rank(1, std::chrono::milliseconds(1000));
  const auto start = std::chrono::steady_clock::now();
  const auto end = job.end();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_NE(end.code, 0);
  EXPECT_NE(end.err.find("exited on signal 9"), std::string::npos) << end.err;
  EXPECT_EQ(scratch_.files().size(), 1U) << "no output, whole or half";
}

TEST_F(Mpi, ALostStageEndsTheJob) {
  std::string data = "t,y\n";
  for (int t = 1; t <= 100000; ++t) data += std::to_string(t) + ",1000\n";
  scratch_.write("d.csv", data);
  for (const std::size_t rank : {0, 1, 2}) {  // chain, proposer, weigher
    Job job(scratch_, 3,
            {"run", "local-level", "--data", "d.csv", "--out", "e.csv", "-n", "20000", "--filter", "imh", "--engine",
             "mpi", "--proposers", "1", "--weighers", "1"});
    ASSERT_EQ(job.started(), 3U);
    job.kill_rank(rank, std::chrono::milliseconds(600));
    const auto start = std::chrono::steady_clock::now();
    const auto end = job.end();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_NE(end.err.find("exited on signal 9"), std::string::npos) << end.err;
    EXPECT_EQ(scratch_.files().size(), 1U) << "no output, whole or half";
  }
}

// Any rank may be lost at any time, also while it hands its state to rank 0 or rank 0 writes it.
TEST_F(Mpi, LostRanksChangeNoByte) {
  ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --steps 400 --out d.csv").code, 0);
  ASSERT_EQ(scratch_.shell("mote run bearings --data d.csv -n 20000 --out whole.csv --engine simd").code, 0);
  int code = -1;
  for (std::size_t attempt = 0; attempt < 6 && code != 0; ++attempt) {
    Job job(scratch_, 2,
            {"run", "bearings", "--data", "d.csv", "-n", "20000", "--out", "e.csv", "--engine", "mpi", "--checkpoint",
             "c", "--checkpoint-every", "20"});
    if (attempt < 5) job.kill_rank(attempt % 2, std::chrono::milliseconds(400 + 97 * attempt));
    const auto end = job.end();
    code = end.code;
    EXPECT_TRUE(code == 0 || (attempt < 5 && end.err.find("exited on signal 9") != std::string::npos)) << end.err;
    if (attempt > 0 || !scratch_.files().contains("c")) continue;
    const Ended other = on(3, "run bearings --data d.csv -n 20000 --out e.csv --engine mpi --checkpoint c");
    EXPECT_EQ(other.code, 2);
    EXPECT_EQ(times(other.err, "with ranks 3, got one with ranks 2"), 1) << other.err;
  }
  EXPECT_EQ(code, 0);
  EXPECT_EQ(scratch_.read("e.csv"), scratch_.read("whole.csv"));
  EXPECT_EQ(scratch_.files().size(), 3U);
}

}  // namespace
}  // namespace mote::testing

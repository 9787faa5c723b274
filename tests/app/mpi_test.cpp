// `mpirun -n R mote run --engine mpi`: the bytes of one process, refusals said once, lost ranks.

#include "tests/app/mpi.hpp"

namespace mote::testing {
namespace {

TEST_F(Mpi, GivesTheBytesOfOneProcess) {
  ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --steps 30 --out d.csv --truth t.csv").code, 0);
  for (const std::string options : {"-n 30001", "-n 8192 --precision float --ess-threshold 0.5 --proposal guided",
                                    "-n 9000 --filter imh --improved", "-n 8192 --filter auxiliary --chains 40"}) {
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

TEST_F(Mpi, SharesGroups) {
  ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --steps 30 --out d.csv").code, 0);
  for (const std::string options : {"--groups 9 --exchange append --exchange-count 2 --topology torus",
                                    "--groups 16 --exchange swap --topology hypercube --ess-threshold 0.5",
                                    "--groups 10 --group-resampling rna --resampler residual"}) {
    const std::string run =
        "run bearings --data d.csv --out e.csv --summary s.json -n 1003 --filter distributed " + options;
    ASSERT_EQ(scratch_.shell("mote " + run).code, 0);
    const std::string expected = scratch_.read("e.csv");
    for (const int ranks : {1, 3, 8}) {
      const Ended ended = on(ranks, run + " --engine mpi");
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_EQ(scratch_.read("e.csv"), expected) << ranks << " ranks, " << options;
    }
  }
}

TEST_F(Mpi, BringsAllParticlesTogetherWhereTheyAreAskedFor) {
  ASSERT_EQ(scratch_.shell("mote simulate ungm --seed 3 --steps 5 --out d.csv").code, 0);
  scratch_.write("d.csv", scratch_.read("d.csv") + "9,\n10,0.7\n");  // steps without observation, too
  for (const std::string options : {"-n 3001 --ess-threshold 0.5", "-n 3001 --filter imh --chains 7 --burn-in 11"}) {
    const std::string run =
        "run ungm --data d.csv --out e.csv --dump-particles p.csv --estimate 'q0.9(x)' --estimate 'P(x>0.2)' " +
        options;
    ASSERT_EQ(scratch_.shell("mote " + run + " --engine simd").code, 0);
    const std::string estimates = scratch_.read("e.csv");
    const std::string particles = scratch_.read("p.csv");
    for (const int ranks : {1, 3}) {
      const Ended ended = on(ranks, run + " --engine mpi");
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_EQ(scratch_.read("e.csv"), estimates) << ranks << " ranks, " << options;
      EXPECT_EQ(scratch_.read("p.csv"), particles) << ranks << " ranks, " << options;
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
           {5, "--filter imh --proposers 1 --weighers 2 --chains 2 --burn-in auto"},
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
           {run + "--filter imh", 2,
            "--engine mpi: expected at most 1 rank for --chains 1: a chain stays on one, got 3"},
           {run + "--filter distributed --groups 2", 2, "at most 2 ranks for --groups 2: a group stays on one, got 3"},
           {run + "--filter distributed --groups 9 --group-resampling global", 2, "groups that resample by themselves"},
           {run + "--filter imh --chains 9 --burn-in auto", 2, "--engine mpi: expected --filter sisr with --resampler"},
           {run + "--resampler residual", 2,
            "--resampler residual --selection-exponent 1 --proposal prior. Pass --engine fastest"},
           {run + "--estimate 'P(nothing>0)'", 2, "got P(nothing>0)"},
           {run + "--dump-particles no/p.csv", 6, "no/p.csv: expected an output that can be written"},
           {run + "--filter imh --proposers 2", 2,
            "4 ranks: 2 that propose, 1 that weigh, 1 with a chain, got 3. Start"},
           {run + "--filter sqmc --weighers 1", 2, "--weighers: expected --filter sisr, imh or auxiliary, got"},
           {run + "--filter imh --data far.csv --weighers 1", 4, "t = 1: the filter collapsed"},
           {run + "--checkpoint-every 3", 2, "--checkpoint-every: expected --checkpoint FILE beside it"},
           {run + "--checkpoint far.csv", 3, "far.csv: expected a checkpoint of mote run, got a file of another kind"},
           {run + "--nope", 2, "mote run: expected an option of mote run, got \"--nope\""},
           {"run local-level --data d.csv --engine mpi -n", 2, "mote run: --particles: expected N, got nothing"},
           {"nope", 2, "mote: COMMAND: expected one of models"},
           {"simulate ungm --steps 0 --out e.csv", 2, "mote simulate: --steps: expected an integer from 1"},
           {"run local-level --data d.csv --out e.csv -n 0", 2, "mote run: --particles: expected an integer from 1"},
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

// Open MPI says which rank was lost, and ends the others.
TEST_F(Mpi, ALostRankEndsTheJob) {
  std::string data = "t,y\n";
  for (int t = 1; t <= 100000; ++t) data += std::to_string(t) + ",1000\n";
  scratch_.write("d.csv", data);
  Job job(scratch_, 3, {"run", "local-level", "--data", "d.csv", "--out", "e.csv", "-n", "100000", "--engine", "mpi"});
  ASSERT_EQ(job.started(), 3U);
  job.signal_rank(1, SIGKILL, std::chrono::milliseconds(1000));
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
    job.signal_rank(rank, SIGKILL, std::chrono::milliseconds(600));
    const auto start = std::chrono::steady_clock::now();
    const auto end = job.end();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_NE(end.err.find("exited on signal 9"), std::string::npos) << end.err;
    EXPECT_EQ(scratch_.files().size(), 1U) << "no output, whole or half";
  }
}

// Any rank may be lost at any time, also while it hands its state to rank 0 or rank 0 writes it.
class LostRanks : public Mpi, public ::testing::WithParamInterface<std::string> {};

TEST_P(LostRanks, ChangeNoByte) {
  prepare_steps("--chains 8 --filter " + GetParam());
  int lost = 0;
  int code = -1;
  for (std::size_t attempt = 0; attempt < 6 && code != 0; ++attempt) {
    Job job(scratch_, 2, steps_by_team({"--chains", "8", "--filter", GetParam()}));
    if (attempt == 0) {
      ASSERT_TRUE(Job::has_written(scratch_, "c"));
    }
    if (attempt < 5) job.signal_rank(attempt % 2, SIGKILL, std::chrono::milliseconds(attempt == 0 ? 0 : 97 * attempt));
    const auto end = job.end();
    code = end.code;
    EXPECT_TRUE(code == 0 || (attempt < 5 && end.err.find("exited on signal 9") != std::string::npos)) << end.err;
    lost += code == 0 ? 0 : 1;
    if (attempt > 0) continue;
    const Ended other = on(3,
                           "run bearings --data d.csv -n 20000 --out e.csv --engine mpi --checkpoint c --chains 8 "
                           "--filter " +
                               GetParam());
    EXPECT_EQ(other.code, 2);
    EXPECT_EQ(times(other.err, "with ranks 3, got one with ranks 2"), 1) << other.err;
  }
  EXPECT_GE(lost, 1);
  EXPECT_EQ(code, 0);
  EXPECT_EQ(scratch_.read("e.csv"), scratch_.read("whole.csv"));
  EXPECT_EQ(scratch_.files().size(), 3U);
}

// A rank that the system stops, or that gets a core half of the time only.
TEST_F(Mpi, AStoppedRankDelaysTheOthersAndNoMore) {
  prepare_steps("");
  using std::chrono::milliseconds;
  Job job(scratch_, 2, steps_by_team({}));
  ASSERT_TRUE(Job::has_written(scratch_, "c"));
  job.signal_rank(1, SIGSTOP, milliseconds(0));
  std::this_thread::sleep_for(milliseconds(1000));
  EXPECT_FALSE(scratch_.files().contains("e.csv")) << "nobody goes on without it";
  job.signal_rank(1, SIGCONT, milliseconds(0));
  for (int k = 0; k < 10; ++k) {
    job.signal_rank(0, SIGSTOP, milliseconds(20));
    job.signal_rank(0, SIGCONT, milliseconds(20));
  }
  const auto end = job.end();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(scratch_.read("e.csv"), scratch_.read("whole.csv"));
}

// As mpirun sends it to all ranks about a second after Ctrl-C.
TEST_F(Mpi, ASignalToOneRankLeavesACheckpoint) {
  prepare_steps("");
  Job job(scratch_, 2, steps_by_team({}));
  ASSERT_TRUE(Job::has_written(scratch_, "c"));
  job.signal_rank(1, SIGTERM, std::chrono::milliseconds(0));
  const auto end = job.end();
  EXPECT_NE(end.code, 0);
  EXPECT_FALSE(scratch_.files().contains("e.csv"));
  EXPECT_EQ(times(end.err, "goes on from c"), 1) << end.err;
  EXPECT_EQ(Job(scratch_, 2, steps_by_team({})).end().code, 0);
  EXPECT_EQ(scratch_.read("e.csv"), scratch_.read("whole.csv"));
}

// Groups, and stages on ranks of their own, compute as the reference engine does, whose bits any processor gives: their
// checkpoints fit it.
TEST_F(Mpi, NotesTheInstructionSetWhereBitsDependOnIt) {
  prepare_steps("");
  const auto noted = [&](int ranks, const std::vector<std::string>& options) {
    Job job(scratch_, ranks, steps_by_team(options));
    EXPECT_TRUE(Job::has_written(scratch_, "c"));
    job.signal_rank(0, SIGKILL, std::chrono::milliseconds(0));
    job.end();
    const std::string kept = scratch_.read("c");
    std::filesystem::remove(scratch_.path() / "c");
    const std::string name = "instruction set";
    return kept.substr(kept.find(name) + name.size() + sizeof(std::uint64_t), 3);  // after the length of the value
  };
  EXPECT_EQ(noted(2, {"--filter", "distributed", "--groups", "4"}), "any");
  EXPECT_EQ(noted(3, {"--filter", "imh", "--proposers", "1"}), "any");
  const std::string of_vectors = noted(2, {});
  EXPECT_TRUE(of_vectors == "SSE" || of_vectors == "AVX") << of_vectors;
}

// The limit is on the ranks' files, and above what MPI itself has in shared memory.
TEST_F(Mpi, AFullDiskLosesNothing) {
  ASSERT_EQ(scratch_.shell("mote simulate bearings --seed 3 --steps 3 --out d.csv").code, 0);
  const std::string run = "run bearings --data d.csv -n 600000 --out ";
  ASSERT_EQ(scratch_.shell("mote " + run + "whole.csv --engine simd").code, 0);
  const std::string kept = run + "e.csv --engine mpi --checkpoint c --checkpoint-every 1";
  const Ended full = scratch_.shell("mpirun -n 2 sh -c 'ulimit -f 30000; exec \"" MOTE_PROGRAM "\" " + kept + "'");
  EXPECT_EQ(full.code, 6) << full.err;
  EXPECT_EQ(times(full.err, "c: expected an output that can be written, got File too large"), 1) << full.err;
  EXPECT_EQ(scratch_.files().size(), 2U) << "no output, no half of a checkpoint";
  EXPECT_EQ(on(2, kept).code, 0);
  EXPECT_EQ(scratch_.read("e.csv"), scratch_.read("whole.csv"));
}

INSTANTIATE_TEST_SUITE_P(Of, LostRanks, ::testing::Values("sisr", "imh"), [](const auto& told) { return told.param; });

}  // namespace
}  // namespace mote::testing

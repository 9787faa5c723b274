// Items on simulated clusters: how they are read and refused, and what is computed of them.

#include <gtest/gtest.h>

#include "mote/app/reproduce/laboratory.hpp"
#include "mote/app/reproduce/script.hpp"
#include "mote/base/refusal.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

/// Lines that a test replaces: of the run (line 8) and of the comparison (from line 15 on).
std::string cluster_item(const std::string& options = R"(["--filter", "imh", "--proposers", "1,2"])",
                         const std::string& compare = "proposers = 2\n") {
  return "item = \"Fig. 0\"\ntitle = \"a cluster\"\nsource = \"a test\"\nprinted = \"nothing\"\n[cluster]\n"
         "options = [\"--platform\", \"ideal\", \"-n\", \"100\", \"--block\", \"1\", \"--tp\", \"2e-6\", \"--tw\", "
         "\"1e-9\", \"--td\", \"1e-9\", \"--steps\", \"2\"]\n[[run]]\nname = \"imh\"\noptions = " +
         options +
         "\n[[figure]]\ntitle = \"time\"\nquantity = \"seconds\"\n[[compare]]\nname = \"gain\"\nkind = \"cluster\"\n"
         "key = \"speedup\"\nruns = [\"imh\"]\nat_least = 1.9\n" +
         compare;
}

reproduce::Laboratory laboratory_for(const Scratch& scratch, const std::string& text) {
  scratch.write("item.toml", text);
  return reproduce::Laboratory(reproduce::read_item(scratch.file("item.toml"), "imh-opt"));
}

TEST(ClusterItems, AreRefusedByFileAndLine) {
  const Scratch scratch;
  const auto refused = [&](const std::string& text) {
    try {
      laboratory_for(scratch, text);
    } catch (const mote::Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kBadData);
      return std::string(refusal.what());
    }
    return std::string("nothing was refused");
  };
  for (const auto& [text, sentence] : std::vector<std::pair<std::string, std::string>>{
           {cluster_item(R"(["--filter", "nope"])"), "item.toml:7: --filter: expected one of sisr, imh, auxiliary"},
           {cluster_item(R"(["--data-parallel"])"), "--data-parallel: expected it, or --stage-parallel, got both"},
           {cluster_item(R"(["--filter", "imh", "--proposers", "1,2"])", "proposers = 3\n"),
            "\"proposers\": expected one of 1, 2, as imh tries, got 3"},
           {cluster_item(R"(["--filter", "imh"])", "proposers = 65\n"), "\"proposers\": expected"},
           {cluster_item(R"(["--filter", "imh"])", "repeats = 3\n"), "\"repeats\""},
           {cluster_item() + "[[compare]]\nname = \"x\"\nkind = \"rmse\"\n", "\"kind\": expected"}}) {
    const std::string said = refused(text);
    EXPECT_NE(said.find("item.toml:"), std::string::npos) << said;
    EXPECT_NE(said.find(sentence), std::string::npos) << said;
  }
}

TEST(ClusterItems, ComputeTheirComparisons) {
  const Scratch scratch;
  reproduce::Laboratory laboratory = laboratory_for(scratch, cluster_item());
  EXPECT_NE(reproduce::script_for(laboratory.item()).find("mote simulate-cluster --stage-parallel --platform ideal"),
            std::string::npos);
  // whatever lies beside this test has no simulator: the item says so, and is not faked
  EXPECT_NE(laboratory.missing().find("mote reproduce: "), std::string::npos);
  std::filesystem::create_directories(scratch.path() / "papers/imh-opt");
  std::string item = cluster_item();
  // 50 and 100 proposals of 2 us, one of a weigher and one of the chain: the laws are exact here
  for (const char* key : {"seconds_over_law", "speedup_over_law", "speedup_over_most"})
    item += std::string("[[compare]]\nname = \"") + key + "\"\nkind = \"cluster\"\nkey = \"" + key +
            "\"\nruns = [\"imh\"]\nproposers = 2\nat_least = 0.999\nat_most = 1.001\n";
  scratch.write("papers/imh-opt/a.toml", item);
  std::filesystem::create_directories(scratch.path() / "bin");
  const std::filesystem::path program = MOTE_PROGRAM;
  std::filesystem::copy_file(program, scratch.path() / "bin/mote");
  const Ended without = scratch.shell("bin/mote reproduce imh-opt --out r");
  EXPECT_EQ(without.code, 0) << without.err;
  EXPECT_NE(without.out.find("skipped imh-opt Fig. 0: mote reproduce: mote-smpi: expected"), std::string::npos)
      << without.out;
  if (!kSimulates) GTEST_SKIP() << "built without SimGrid";
  std::filesystem::copy_file(program.parent_path() / "mote-smpi", scratch.path() / "bin/mote-smpi");
  const Ended ended = scratch.shell("bin/mote reproduce imh-opt --out r");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("holds          imh-opt Fig. 0: gain: 2 "), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find("DOES NOT HOLD"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("holds          imh-opt Fig. 0: speedup_over_most: "), std::string::npos) << ended.out;
  EXPECT_NE(scratch.read("r/imh-opt-fig-0.csv").find("imh,2,1,1,0.000"), std::string::npos);
}

}  // namespace
}  // namespace mote::testing

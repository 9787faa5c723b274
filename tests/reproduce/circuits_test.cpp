// Circuits among an item's runs: their golden models filter, with no tool beside the program; figures need the tools.

#include <gtest/gtest.h>

#include "mote/app/reproduce/laboratory.hpp"
#include "mote/app/reproduce/script.hpp"
#include "mote/base/parallel.hpp"
#include "mote/base/refusal.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

/// Two filters of the growth model, one a circuit.
std::string circuit_item(const std::string& compare, const std::string& words = R"("--arch", "imh", "-n", "200")") {
  return "item = \"Table 0\"\ntitle = \"a circuit\"\nsource = \"a test\"\nprinted = \"nothing\"\n[simulate]\n"
         "model = \"ungm\"\nsteps = 20\n[[run]]\nname = \"circuit\"\ncircuit = true\noptions = [" +
         words +
         "]\n[[run]]\nname = \"double\"\noptions = [\"--filter\", \"imh\", \"-n\", \"200\"]\n[[figure]]\n"
         "title = \"mean\"\nstate = \"x\"\n[[compare]]\nname = \"compared\"\n" +
         compare;
}

reproduce::Laboratory laboratory_for(const std::string& text) {
  const Scratch scratch;
  scratch.write("item.toml", text);
  return reproduce::Laboratory(reproduce::read_item(scratch.file("item.toml"), "imh-hw"));
}

constexpr const char* kCycles = "kind = \"circuit\"\nkey = \"cycles\"\nruns = [\"circuit\"]\nat_most = 1e6\n";

// claim    a circuit's golden model filters as the filter in double does
// design   20 recordings of 20 steps, 200 particles; fixed seeds
// twin     a circuit of 2 particles must be caught
TEST(CircuitItems, CompareAGoldenModelWithTheFilter) {
  const std::string rmse =
      "kind = \"rmse\"\nstate = \"x\"\nruns = [\"circuit\", \"double\"]\nrepeats = 20\nat_most = 1.15\n";
  auto right = laboratory_for(circuit_item(rmse)).regenerate([] {});
  EXPECT_TRUE(right.results.front().holds) << right.results.front().ours;
  EXPECT_EQ(right.records.size(), 2U);
  auto twin = laboratory_for(circuit_item(rmse, R"("--arch", "imh", "-n", "2")")).regenerate([] {});
  EXPECT_FALSE(twin.results.front().holds) << twin.results.front().ours;
}

// claim    a figure does not depend on when its tool ran, nor on which ran beside it or on a simulation before
// referee  the golden model's cycles and IMH's law, which take no tool
// design   two circuits, simulated side by side, the last one first, and once more for the law
TEST(CircuitItems, TakeTheirToolsInAnyOrder) {
  const auto figure = [](const std::string& key, const std::string& run) {
    return "[[compare]]\nname = \"" + key + " of " + run + "\"\nkind = \"circuit\"\nkey = \"" + key + "\"\nruns = [\"" +
           run + "\"]\nat_most = 1e6\n";
  };
  auto laboratory = laboratory_for(circuit_item(kCycles + figure("golden_cycles", "circuit") +
                                                    figure("step_cycles_over_law", "circuit") +
                                                    figure("cycles", "small") + figure("golden_cycles", "small"),
                                                R"("--arch", "imh", "-n", "200"]
[[run]]
name = "small"
circuit = true
options = ["--arch", "sisr", "-n", "50")"));
  const auto errands = laboratory.errands();
  ASSERT_EQ(errands.size(), 2U);
  in_parallel(2, 2, [&](std::size_t k) { errands[1 - k](); });
  const auto results = laboratory.regenerate([] {}).results;
  ASSERT_EQ(results.size(), 5U);
  EXPECT_EQ(results[0].ours, results[1].ours);
  EXPECT_EQ(results[2].ours, 1);
  EXPECT_EQ(results[3].ours, results[4].ours);
  EXPECT_NE(results[0].ours, results[3].ours);
}

TEST(CircuitItems, GoOnWithoutTheToolsAndSaySo) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  auto laboratory = laboratory_for(circuit_item(kCycles));
  EXPECT_EQ(laboratory.missing(), "");
  const auto outcome = laboratory.regenerate([] {});
  setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(outcome.results.empty());
  EXPECT_EQ(outcome.records.size(), 2U);
  ASSERT_EQ(outcome.left_out.size(), 1U);
  EXPECT_EQ(outcome.left_out.front(),
            "left out compared: there is no verilator. Install it: apt-get install verilator.");
}

TEST(CircuitItems, AreRefusedByFileAndLine) {
  for (const auto& [text, sentence] : std::vector<std::pair<std::string, std::string>>{
           {circuit_item(kCycles, R"("--arch", "nope")"), "--arch: expected one of imh"},
           {circuit_item("kind = \"circuit\"\nkey = \"cycles\"\nruns = [\"double\"]\nat_most = 1\n"),
            "\"runs\": expected names of runs with circuit = true"},
           {circuit_item("kind = \"circuit\"\nkey = \"milliseconds\"\nmhz = -1\nruns = [\"circuit\"]\nat_most = 1\n"),
            "\"mhz\": expected a number above 0"},
           {circuit_item(std::string(kCycles) + "mhz = 100\n"), "\"mhz\": expected one of"}}) {
    try {
      laboratory_for(text);
      ADD_FAILURE() << "nothing was refused: " << sentence;
    } catch (const mote::Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kBadData);
      const std::string said = refusal.what();
      EXPECT_NE(said.find("item.toml:"), std::string::npos) << said;
      EXPECT_NE(said.find(sentence), std::string::npos) << said;
    }
  }
}

TEST(CircuitItems, HaveTheirCommands) {
  const std::string script = reproduce::script_for(laboratory_for(circuit_item(kCycles)).item());
  EXPECT_NE(script.find("mote rtl ungm --simulate "), std::string::npos) << script;
  EXPECT_NE(script.find("--arch imh -n 200"), std::string::npos) << script;
}

}  // namespace
}  // namespace mote::testing

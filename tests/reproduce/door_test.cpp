// `mote reproduce` as a user meets it, with papers of the test's own beside a copy of the program.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/reproduce/sample_item.hpp"

namespace mote::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A folder with a program and its papers: bin/mote, papers/<name>/<file>.
class Press {
 public:
  Press() {
    fs::create_directories(scratch_.path() / "bin");
    fs::copy_file(MOTE_PROGRAM, scratch_.path() / "bin/mote");
  }
  void add(const std::string& paper, const std::string& file, const std::string& text) const {
    fs::create_directories(scratch_.path() / "papers" / paper);
    scratch_.write("papers/" + paper + "/" + file, text);
  }
  Ended reproduce(const std::string& words) const { return scratch_.shell("bin/mote reproduce " + words); }
  Json comparison(const std::string& folder) const { return Json::parse(scratch_.read(folder + "/comparison.json")); }
  bool has(const std::string& path) const { return fs::exists(scratch_.path() / path); }
  std::string read(const std::string& path) const { return scratch_.read(path); }
  const Scratch& scratch() const { return scratch_; }

 private:
  Scratch scratch_;
};

TEST(ReproduceDoor, WritesPageFiguresAndComparisonOfEveryPaper) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item());
  press.add("mixed", "b.toml", sample_item({.compare = "paper = 2\nwithin = 0.5\n"}));
  const Ended ended = press.reproduce("all --out deep/er");
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const std::string file : {"index.html", "imh-hw-fig-0.csv", "mixed-fig-0.csv"})
    EXPECT_TRUE(press.has("deep/er/" + file)) << file;
  const Json comparison = press.comparison("deep/er");
  ASSERT_EQ(comparison.size(), 2U);
  EXPECT_EQ(comparison[0]["item"], "imh-hw Fig. 0: difference");
  EXPECT_TRUE(comparison[0]["paper"].is_null() && comparison[0]["ratio"].is_null());
  EXPECT_EQ(comparison[1]["paper"], 2.0);
  EXPECT_DOUBLE_EQ(comparison[1]["ratio"].get<double>(), comparison[1]["ours"].get<double>() / 2);
  EXPECT_NE(ended.out.find("fpga: no items yet"), std::string::npos) << ended.out;
}

TEST(ReproduceDoor, TheSameNumbersEveryTime) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item());
  ASSERT_EQ(press.reproduce("imh-hw --out one").code, 0);
  ASSERT_EQ(press.reproduce("imh-hw --out two").code, 0);
  for (const std::string file : {"/comparison.json", "/imh-hw-fig-0.csv"})
    EXPECT_EQ(press.read("one" + file), press.read("two" + file));
}

TEST(ReproduceDoor, TakesAsManyRepeatsAsAsked) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item());
  ASSERT_EQ(press.reproduce("imh-hw --out r --repeats 5").code, 0);
  EXPECT_NE(press.comparison("r")[0]["note"].get<std::string>().find("; 5 repeats"), std::string::npos);
  EXPECT_EQ(press.reproduce("imh-hw --out r --repeats 1").code, 2);
}

TEST(ReproduceDoor, SaysWhenAPaperHasNoItems) {
  const Press press;
  press.add("imh-hw", "README.md", "nothing yet");
  const Ended ended = press.reproduce("imh-hw --out r");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("imh-hw: no items yet"), std::string::npos);
  EXPECT_EQ(press.comparison("r"), Json::array());
  EXPECT_TRUE(press.has("r/index.html"));
}

TEST(ReproduceDoor, AResultThatDoesNotHoldIsNoError) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item({.run = "set = [\"sigma_o=0.8\"]"}));
  const Ended ended = press.reproduce("imh-hw --out r");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("DOES NOT HOLD  imh-hw Fig. 0: difference"), std::string::npos) << ended.out;
  EXPECT_FALSE(press.comparison("r")[0]["holds"].get<bool>());
}

TEST(ReproduceDoor, ACollapsedFilterIsNoError) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item({.run = "set = [\"sigma_o=1e-170\"]"}));
  const Ended ended = press.reproduce("imh-hw --out r");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json entry = press.comparison("r")[0];
  EXPECT_TRUE(entry["ours"].is_null()) << entry.dump();
  EXPECT_FALSE(entry["holds"].get<bool>());
  EXPECT_NE(press.read("r/index.html").find("the filter collapsed"), std::string::npos);
}

// claim    tools that fail side by side end the program with the one sentence of the first, and nothing is written
TEST(ReproduceDoor, AToolThatFailsIsNamedOnce) {
  const Press press;
  std::string item = sample_item();
  for (const std::string n : {"50", "60"})
    item += "[[run]]\nname = \"" + n + "\"\ncircuit = true\noptions = [\"--arch\", \"imh\", \"-n\", \"" + n +
            "\"]\n[[compare]]\nname = \"cycles " + n + "\"\nkind = \"circuit\"\nkey = \"cycles\"\nruns = [\"" + n +
            "\"]\nat_most = 1e6\n";
  press.add("imh-hw", "a.toml", item);
  press.scratch().shell("mkdir tools");
  press.scratch().write("tools/verilator", "#!/bin/sh\necho broken >&2\nexit 3\n");
  press.scratch().shell("chmod +x tools/verilator");
  const Ended ended = press.scratch().shell("PATH=\"$PWD/tools:$PATH\" bin/mote reproduce imh-hw --out r");
  EXPECT_EQ(ended.code, 5) << ended.err;
  EXPECT_EQ(ended.err.find("verilator"), ended.err.rfind("verilator: expected exit code 0, got 3")) << ended.err;
  EXPECT_NE(ended.err.find("broken"), std::string::npos) << ended.err;
  EXPECT_FALSE(press.has("r/index.html"));
}

TEST(ReproduceDoor, RefusesABrokenItemBeforeAnyWork) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item());
  press.add("imh-hw", "b.toml", "item = \"Fig. 1\"\ncolour = 3\n");
  const Ended ended = press.reproduce("imh-hw --out r");
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("papers/imh-hw/b.toml:1: \"title\": expected a text, got nothing."), std::string::npos)
      << ended.err;
  EXPECT_FALSE(press.has("r"));
}

TEST(ReproduceDoor, RefusesTwoItemsOfOneName) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item());
  press.add("imh-hw", "b.toml", sample_item());
  const Ended ended = press.reproduce("imh-hw --out r");
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("a name that no other item has"), std::string::npos) << ended.err;
}

TEST(ReproduceDoor, RefusesWithoutPapersAndNamesWhereItLooked) {
  const Press press;
  const Ended ended = press.reproduce("imh-hw --out r");
  EXPECT_EQ(ended.code, 3);
  const std::string home = fs::canonical(press.scratch().path()).string();
  EXPECT_NE(ended.err.find(home + "/papers or " + home + "/share/mote/papers"), std::string::npos) << ended.err;
}

TEST(ReproduceDoor, FindsInstalledPapers) {
  const Press press;
  fs::create_directories(press.scratch().path() / "share/mote/papers");
  EXPECT_EQ(press.reproduce("imh-hw --out r").code, 0);
}

TEST(ReproduceDoor, RefusesUnknownPapersAndFoldersThatAreFiles) {
  const Press press;
  press.add("imh-hw", "a.toml", sample_item());
  const Ended unknown = press.reproduce("imh-sw --out r");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("one of imh-hw, fpga, mixed, imh-opt, ppf, all"), std::string::npos) << unknown.err;
  EXPECT_EQ(press.reproduce("imh-hw").code, 2);
  press.scratch().write("file", "");
  EXPECT_EQ(press.reproduce("imh-hw --out file").code, 6);
}

}  // namespace
}  // namespace mote::testing

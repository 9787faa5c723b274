#include "mote/app/explore/journal.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"
#include "mote/base/parallel.hpp"
#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"

namespace mote::explore {
namespace {

const RunFacts kOurs{{"mote", "1"}, {"MODEL", "ungm"}};
const std::string kHead = R"({"exploration":[["mote","1"],["MODEL","ungm"]]})"
                          "\n";

std::string text_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<double> never() {
  ADD_FAILURE() << "it is known";
  return {};
}

TEST(Journal, KeepsFindingsFromOneExplorationToTheNext) {
  const ScratchFolder folder;
  const std::string path = folder.file("state");
  {
    Journal journal(path, kOurs);
    EXPECT_EQ(journal.recall("time", 2, [] { return std::vector<double>{0.1, kInfinity}; }).front(), 0.1);
    journal.keep(3, 7, {1.0 / 3, kNaN});
    journal.keep(3, 8, {kInfinity, 2});
  }
  Journal journal(path, kOurs);
  EXPECT_EQ(journal.recall("time", 2, never), (std::vector<double>{0.1, kInfinity}));
  ASSERT_TRUE(journal.errors(3, 7));
  EXPECT_EQ(journal.errors(3, 7)->reference, 1.0 / 3) << "to the bit";
  EXPECT_TRUE(std::isnan(journal.errors(3, 7)->truth));
  EXPECT_TRUE(std::isinf(journal.errors(3, 8)->reference));
  EXPECT_FALSE(journal.errors(3, 9));
}

// claim    wherever a file was cut off, what is whole is kept and the rest is found again
TEST(Journal, GoesOnFromAnyPlaceThatItWasCutOffAt) {
  const ScratchFolder folder;
  const std::string path = folder.file("state");
  const auto fill = [](Journal& journal) {
    journal.recall("time", 1, [] { return std::vector<double>{0.5}; });
    for (std::size_t run = 0; run < 4; ++run) journal.keep(0, run, {0.25 * static_cast<double>(run), 1});
  };
  {
    Journal journal(path, kOurs);
    fill(journal);
  }
  const std::string whole = text_of(path);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    {
      Journal journal(path, kOurs);
      fill(journal);
    }
    ASSERT_EQ(text_of(path), whole) << length;
  }
}

/// What reading a file ends with: an exit code and a sentence; the file stays as it is.
std::pair<ExitCode, std::string> refused(const std::string& text) {
  const ScratchFolder folder;
  const std::string path = folder.file("state");
  std::ofstream(path) << text;
  try {
    Journal journal(path, kOurs);
    journal.recall("time", 2, [] { return std::vector<double>{1, 2}; });
  } catch (const Refusal& refusal) {
    EXPECT_EQ(text_of(path), text);
    return {refusal.code(), refusal.what()};
  }
  return {ExitCode::kDone, ""};
}

TEST(Journal, SaysWhatAnotherExplorationIsOf) {
  const auto [code, sentence] = refused(R"({"exploration":[["mote","1"],["MODEL","doa"]]})"
                                        "\n");
  EXPECT_EQ(code, ExitCode::kWrongUse);
  EXPECT_NE(sentence.find("with MODEL ungm, got those of one with MODEL doa"), std::string::npos) << sentence;
}

// claim    a line that no exploration wrote is named, whatever is wrong with it
// twin     the same lines, whole
TEST(Journal, NamesTheLineThatIsDamaged) {
  const std::string good = R"({"found":"time","values":[1,"inf"]})"
                           "\n"
                           R"({"candidate":0,"run":1,"reference":0.5,"truth":null})"
                           "\n";
  EXPECT_EQ(refused(kHead + good).first, ExitCode::kDone);
  for (const std::string line :
       {R"({"foo":1})", R"([1])", "7", R"({"found")", R"({"found":7,"values":[1,2]})", R"({"found":"time"})",
        R"({"found":"time","values":[1,"x"]})", R"({"found":"time","values":[1,null]})",
        R"({"candidate":-1,"run":0,"reference":1,"truth":1})", R"({"candidate":0,"run":0,"reference":null,"truth":1})",
        R"({"candidate":0,"run":0,"reference":-1,"truth":1})", R"({"candidate":0,"run":0})", ""}) {
    const auto [code, sentence] = refused(kHead + good + line + "\n");
    EXPECT_EQ(code, ExitCode::kBadData) << line;
    EXPECT_NE(sentence.find("state:4: expected a finding of mote design explore, got "), std::string::npos) << sentence;
  }
  const auto [code, sentence] = refused(kHead + R"({"found":"time","values":[1]})"
                                                "\n");
  EXPECT_EQ(code, ExitCode::kBadData);
  EXPECT_NE(sentence.find("state:2: expected 2 values of \"time\", got 1"), std::string::npos) << sentence;
  for (const std::string first : {"t,y\n1,2\n", "{\"exploration\":1}\n", "{\"foo\":1}\n"})
    EXPECT_EQ(refused(first).first, ExitCode::kBadData) << first;
  EXPECT_THROW(Journal(ScratchFolder().file("no/such/folder"), kOurs), Refusal);
}

// claim    what several threads ask for at once is found once
// twin     a finder that is called by each of them would count 4
TEST(Journal, FindsOnceWhatSeveralThreadsAskFor) {
  Journal journal("", {});
  std::atomic<int> found{0};
  const auto slowly = [&] {
    ++found;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return std::vector<double>{7};
  };
  in_parallel(4, 4, [&](std::size_t) { EXPECT_EQ(journal.recall("part", 1, slowly).front(), 7); });
  EXPECT_EQ(found, 1);
  EXPECT_THROW(journal.recall("other", 1, []() -> std::vector<double> { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(journal.recall("other", 1, slowly).front(), 7) << "whoever failed holds up nobody";
}

}  // namespace
}  // namespace mote::explore

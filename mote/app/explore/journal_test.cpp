#include "mote/app/explore/journal.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"

namespace mote::explore {
namespace {

using Json = nlohmann::json;

const Json kOurs{{"exploration", 1}, {"model", "ungm"}};

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
    EXPECT_EQ(journal.recall("time", [] { return std::vector<double>{0.1, kInfinity}; }).front(), 0.1);
    journal.keep(3, 7, {1.0 / 3, kNaN});
    journal.keep(3, 8, {kInfinity, 2});
  }
  Journal journal(path, kOurs);
  EXPECT_EQ(journal.recall("time", never), (std::vector<double>{0.1, kInfinity}));
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
    journal.recall("time", [] { return std::vector<double>{0.5}; });
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

TEST(Journal, RefusesWhatIsNotItsOwn) {
  const ScratchFolder folder;
  const auto code_of = [&](const std::string& text) {
    const std::string path = folder.file("state");
    std::ofstream(path) << text;
    try {
      const Journal journal(path, kOurs);
    } catch (const Refusal& refusal) {
      EXPECT_EQ(text_of(path), text) << "it stays as it is";
      return refusal.code();
    }
    return ExitCode::kDone;
  };
  EXPECT_EQ(code_of("{\"exploration\":1,\"model\":\"doa\"}\n"), ExitCode::kWrongUse);
  EXPECT_EQ(code_of("t,y\n1,2\n"), ExitCode::kBadData);
  EXPECT_EQ(code_of(kOurs.dump() + "\n{\"found\"\n"), ExitCode::kBadData);
  EXPECT_EQ(code_of(kOurs.dump() + "\n"), ExitCode::kDone);
  EXPECT_THROW(Journal(folder.file("no/such/folder"), kOurs), Refusal);
}

}  // namespace
}  // namespace mote::explore

#include "mote/app/files/checkpoint_file.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;

const RunFacts kFacts{{"MODEL", "growth"}, {"--particles", "1000"}, {"--draws", ""}};

class CheckpointFiles : public ::testing::Test {
 protected:
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void set_bytes(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  KeepRun keeper(std::vector<double>& state) const {
    return [&state](Archive& archive) { archive(state); };
  }
  void write(std::vector<double> state) const { CheckpointFile(path_, kFacts, 1).step_done(keeper(state)); }

  /// Expects the file to be refused in a sentence that holds `got`, and to stay as it is.
  void expect_refused(ExitCode code, const std::string& got, const RunFacts& facts = kFacts) const {
    const std::string before = bytes();
    try {
      const CheckpointFile file(path_, facts, 1);
      ADD_FAILURE() << "took " << got;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), code) << refusal.what();
      EXPECT_NE(std::string(refusal.what()).find(got), std::string::npos) << refusal.what();
    }
    EXPECT_EQ(bytes(), before);
  }

  ScratchFolder folder_;
  std::string path_ = folder_.file("c");
};

TEST_F(CheckpointFiles, GiveBackWhatTheyTook) {
  std::vector<double> state;
  EXPECT_FALSE(CheckpointFile(path_, kFacts, 1).resume(keeper(state)));
  write({1, 2, 3});
  write({4, 5});
  CheckpointFile file(path_, kFacts, 1);
  EXPECT_TRUE(file.found());
  EXPECT_TRUE(file.resume(keeper(state)));
  EXPECT_EQ(state, (std::vector<double>{4, 5}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1)
      << "nothing else is left";
  file.remove();
  EXPECT_FALSE(CheckpointFile(path_, kFacts, 1).found());
}

TEST_F(CheckpointFiles, AreWrittenEverySoManySteps) {
  std::vector<double> state{1};
  CheckpointFile file(path_, kFacts, 3);
  std::size_t written = 0;
  for (int step = 1; step <= 10; ++step) {
    fs::remove(path_);
    file.step_done(keeper(state));
    written += fs::exists(path_) ? 1 : 0;
    EXPECT_EQ(fs::exists(path_), step % 3 == 0) << step;
  }
  EXPECT_EQ(written, 3U);
  file.stopped(keeper(state));
  EXPECT_TRUE(fs::exists(path_)) << "and whenever the run stops";
}

TEST_F(CheckpointFiles, AreNotWrittenAtOnceByTime) {
  std::vector<double> state{1};
  CheckpointFile file(path_, kFacts, {});
  for (int step = 0; step < 1000; ++step) file.step_done(keeper(state));
  EXPECT_FALSE(fs::exists(path_));
}

// Every single bit that is wrong is noticed: CRC-32 finds all errors of one bit.
TEST_F(CheckpointFiles, AreRefusedWithAnyBitWrong) {
  write({1, 2, 3});
  const std::string whole = bytes();
  ASSERT_GT(whole.size(), 100U);
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string wrong = whole;
      wrong[i] = static_cast<char>(wrong[i] ^ (1 << bit));
      set_bytes(wrong);
      expect_refused(ExitCode::kBadData, i < 16   ? "a file of another kind"
                                         : i < 20 ? "which another mote wrote"
                                         : i < 28 ? "got one "  // of another length
                                                  : "its checksum is wrong");
    }
}

TEST_F(CheckpointFiles, AreRefusedCutShortOrTooLong) {
  write({1, 2, 3});
  const std::string whole = bytes();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    set_bytes(whole.substr(0, length));
    expect_refused(ExitCode::kBadData, "one cut short after " + std::to_string(length));
  }
  set_bytes(whole + '\0');
  expect_refused(ExitCode::kBadData, "its checksum is wrong");
}

TEST_F(CheckpointFiles, AreRefusedByAnotherRun) {
  write({1});
  RunFacts other = kFacts;
  other[1].second = "2000";
  expect_refused(ExitCode::kWrongUse, "a checkpoint of this run, with --particles 2000, got one with --particles 1000",
                 other);
  other = kFacts;
  other[2].second = "5000";
  expect_refused(ExitCode::kWrongUse, "with --draws 5000, got one with --draws not given", other);
  other = kFacts;
  other.emplace_back("--new", "1");
  expect_refused(ExitCode::kWrongUse, "those of another mote", other);
}

TEST_F(CheckpointFiles, AreRefusedByAStateOfAnotherShape) {
  write({1, 2});
  std::array<double, 3> three{};
  CheckpointFile file(path_, kFacts, 1);
  EXPECT_THROW(file.resume([&](Archive& archive) { archive.fill(std::span(three)); }), Refusal);
  EXPECT_THROW(file.resume([&](Archive&) {}), Refusal) << "something is left";
}

}  // namespace
}  // namespace mote

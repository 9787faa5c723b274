#include "mote/app/files/output.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;

class Outputs : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  std::string text_of(const std::string& name) const {
    std::ifstream file(path(name));
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  /// A file as a writer leaves it between its name aside and its own: locked as long as the descriptor is open.
  int begun(const std::string& name) const {
    const int descriptor = open(path(name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    EXPECT_EQ(flock(descriptor, LOCK_EX), 0);
    return descriptor;
  }

  ScratchFolder folder_;
};

TEST_F(Outputs, AppearByCommit) {
  {
    Output output(path("a"));
    output.write("text");
    output.finish();
    EXPECT_FALSE(fs::exists(path("a")));
    output.commit();
  }
  EXPECT_EQ(text_of("a"), "text");
  EXPECT_EQ(files(), 1);
}

TEST_F(Outputs, LeaveNothingWithoutCommit) {
  std::ofstream(path("a")) << "old";
  {
    Output output(path("a"));
    output.write("new");
    output.finish();
  }
  EXPECT_EQ(text_of("a"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(Outputs, RemoveWhatAKilledWriterLeft) {
  close(begun("a.mote.part"));
  Output output(path("a"));
  EXPECT_EQ(files(), 0) << "when they are opened";
  close(begun("a.mote.part"));
  output.write("text");
  output.commit();
  EXPECT_EQ(text_of("a"), "text") << "and when they need the name";
  EXPECT_EQ(files(), 1);
}

TEST_F(Outputs, LeaveALivingWriterItsFile) {
  const int writer = begun("a.mote.part");
  Output output(path("a"));
  EXPECT_EQ(files(), 1);
  output.write("ours");
  std::thread living([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_FALSE(fs::exists(path("a"))) << "the other waits";
    fs::rename(path("a.mote.part"), path("a"));
    close(writer);
  });
  output.commit();
  living.join();
  EXPECT_EQ(text_of("a"), "ours") << "the later one";
  EXPECT_EQ(files(), 1);
}

TEST_F(Outputs, TakeAnotherNameWhereTheirsIsNoOrphan) {
  fs::create_directory(path("a.mote.part"));
  Output output(path("a"));
  output.write("text");
  output.commit();
  EXPECT_EQ(text_of("a"), "text");
  EXPECT_EQ(files(), 2) << "what they have not made stays";
}

// A writer that does nothing but commit is killed until that has hit it between its two names some times.
TEST_F(Outputs, KilledAtAnyTimeLeaveNothingThatTheNextDoesNotRemove) {
  int orphans = 0;
  for (int k = 0; k < 1000 && orphans < 3; ++k) {
    const pid_t writer = fork();
    ASSERT_GE(writer, 0);
    while (writer == 0) {
      Output output(path("a"));
      output.write("text");
      output.commit();
      unlink(path("a").c_str());  // where a name is replaced, file systems take their time after the window
    }
    std::this_thread::sleep_for(std::chrono::microseconds(2000 + 7 * k));
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    orphans += fs::exists(path("a.mote.part")) ? 1 : 0;
    const Output next(path("a"));
    ASSERT_TRUE(files() == 0 || (files() == 1 && text_of("a") == "text")) << files() << " files";
  }
  EXPECT_EQ(orphans, 3) << "otherwise little was tried";
}

TEST_F(Outputs, AreCommittedTogether) {
  OutputSet set;
  EXPECT_EQ(set.open(""), nullptr);
  set.open(path("a"))->write("1");
  set.open(path("b"))->write("2");
  EXPECT_FALSE(set.on_standard_output());
  set.commit();
  EXPECT_EQ(text_of("a") + text_of("b"), "12");
}

TEST_F(Outputs, NeverShareAFile) {
  fs::create_symlink("a", path("link"));
  OutputSet set;
  set.open(path("a"));
  for (const std::string& same : {path("a"), path("./a"), path("link"), path("x/../a")})
    EXPECT_THROW(set.open(same), Refusal) << same;
}

TEST_F(Outputs, NeverGoOverAnInput) {
  std::ofstream(path("data")) << "precious";
  OutputSet set;
  set.protect(path("data"));
  set.protect("");
  EXPECT_THROW(set.open(path("data")), Refusal);
  EXPECT_NO_THROW(set.open(path("other")));
  set.protect("/dev/null");
  EXPECT_NO_THROW(set.open("/dev/null")) << "what is no file may be both";
}

TEST_F(Outputs, SayWhichCannotBeWritten) {
  for (const std::string& bad : {path("no/a"), folder_.path().string(), folder_.path().string() + "/", path("a/")}) {
    try {
      const Output output(bad);
      ADD_FAILURE() << bad;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kCannotWrite);
      EXPECT_TRUE(std::string(refusal.what()).starts_with(bad + ": expected an output that can be written, got "));
    }
  }
  Output full("/dev/full");
  full.write("x");
  EXPECT_THROW(full.finish(), Refusal);
}

TEST(Exact, ReadsBackToTheSameBits) {
  for (const double value : {0.1, -0.0, 1e-310, 1.7976931348623157e308, 1.0 / 3})
    EXPECT_EQ(std::strtod(exact(value).c_str(), nullptr), value);
  EXPECT_EQ(exact(std::nan("")), "nan");
  EXPECT_EQ(exact(-HUGE_VAL), "-inf");
}

}  // namespace
}  // namespace mote

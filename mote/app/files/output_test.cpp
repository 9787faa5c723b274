#include "mote/app/files/output.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
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

// Outputs appear whole or not at all, whatever ends the program; signals end it cleanly.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

std::string long_recording() {
  std::string data = "t,y\n";
  for (int t = 1; t <= 20000; ++t) data += std::to_string(t) + ",1000\n";
  return data;
}

/// A named pipe that the program writes to: its first byte tells that the program is at work.
class Pipe {
 public:
  explicit Pipe(const Scratch& scratch) : path_(scratch.file("pipe")) { mkfifo(path_.c_str(), 0600); }
  ~Pipe() {
    if (end_ >= 0) close(end_);
    unlink(path_.c_str());
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  Pipe(Pipe&&) = delete;
  Pipe& operator=(Pipe&&) = delete;

  /// Waits for the program to open the pipe and to write.
  void await() {
    end_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    char byte = 0;
    EXPECT_EQ(::read(end_, &byte, 1), 1);
  }
  /// Reads until the program closes its end.
  void drain() const {
    char buffer[1U << 16U];
    while (::read(end_, buffer, sizeof buffer) > 0) {
    }
  }

 private:
  std::string path_;
  int end_ = -1;
};

const std::vector<std::string> kRun{
    "run",      "local-level", "--data",           "d.csv", "-n", "20000", "--out", "e.csv", "--summary", "s.json",
    "--report", "r.html",      "--dump-particles", "pipe"};
const std::vector<std::string> kSimulate{"simulate", "ungm", "--steps", "10000000",
                                         "--out",    "pipe", "--truth", "t.csv"};

struct Interruption {
  std::string name;
  std::vector<std::string> words;
  int signal;
  bool reader_reads;  // after the signal: else the program hangs in a write
  int code;
  std::string sentence;
};

std::ostream& operator<<(std::ostream& out, const Interruption& i) { return out << i.name; }

class Interrupted : public ::testing::TestWithParam<Interruption> {};

TEST_P(Interrupted, LeavesNoFile) {
  const Interruption& c = GetParam();
  const Scratch scratch;
  scratch.write("d.csv", long_recording());
  scratch.write("e.csv", "old");
  {
    Pipe pipe(scratch);
    Child child(scratch, c.words);
    pipe.await();
    if (!c.reader_reads) std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the pipe is full by then
    child.signal(c.signal);
    if (c.reader_reads) pipe.drain();
    const auto end = child.end();
    EXPECT_EQ(end.code, c.code) << end.err;
    EXPECT_NE(end.err.find(c.sentence), std::string::npos) << end.err;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), c.sentence.empty() ? 0 : 1) << end.err;
  }
  EXPECT_EQ(scratch.files().size(), 2U) << "d.csv and the old e.csv stay";
  EXPECT_EQ(scratch.read("e.csv"), "old");
}

INSTANTIATE_TEST_SUITE_P(
    Outputs, Interrupted,
    ::testing::Values(
        Interruption{"RunByCtrlC", kRun, SIGINT, true, 130, "of 20000 steps; no file was written."},
        Interruption{"RunBySigterm", kRun, SIGTERM, true, 130, "of 20000 steps; no file was written."},
        Interruption{"RunByHangup", kRun, SIGHUP, true, 130, "of 20000 steps; no file was written."},
        Interruption{"RunInAWrite", kRun, SIGINT, false, 130, "pipe: interrupted while it was written."},
        Interruption{"RunKilled", kRun, SIGKILL, true, 128 + SIGKILL, ""},
        Interruption{"SimulateByCtrlC", kSimulate, SIGINT, true, 130, "of 10000000 steps; no file was written."},
        Interruption{"SimulateBySigterm", kSimulate, SIGTERM, true, 130, "of 10000000 steps; no file was written."},
        Interruption{"SimulateInAWrite", kSimulate, SIGINT, false, 130, "pipe: interrupted while it was written."}),
    [](const auto& test) { return test.param.name; });

TEST(Interrupted, WaitingForData) {
  const Scratch scratch;
  ASSERT_EQ(mkfifo(scratch.file("pipe").c_str(), 0600), 0);
  Child child(scratch, {"run", "local-level", "--data", "pipe", "--out", "e.csv"});
  const int end = open(scratch.file("pipe").c_str(), O_WRONLY | O_CLOEXEC);  // returns when the program reads
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  child.signal(SIGTERM);
  const auto ended = child.end();
  close(end);
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_EQ(ended.err, "pipe: interrupted while it was read.\n");
  EXPECT_TRUE(scratch.files().empty());
}

// What the caller has switched off stays off: nohup, and the shell's Ctrl-C for jobs in the background.
TEST(Interrupted, NotWhenTheCallerSaysSo) {
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1000\n2,1000\n");
  const Ended ended = scratch.shell("mkfifo pipe; (trap '' HUP INT; exec '" MOTE_PROGRAM
                                    "' run local-level --data d.csv --out e.csv --dump-particles pipe) & id=$!; exec "
                                    "3<pipe; head -c 1 <&3 >/dev/null; "
                                    "kill -HUP $id; kill -INT $id; cat <&3 >/dev/null; wait $id");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(scratch.read("e.csv").starts_with("t,level_mean"));
}

TEST(Outputs, AReaderThatLeavesIsAFailedWrite) {
  const Scratch scratch;
  scratch.write("d.csv", long_recording());
  for (const std::string out : {"/dev/stdout", "-"}) {
    const Ended ended =
        scratch.shell("{ mote run local-level --data d.csv -n 10 --out " + out + "; echo $? >code; } | head -1");
    EXPECT_EQ(scratch.read("code"), "6\n") << ended.err;
    EXPECT_EQ(ended.err,
              "standard output: expected an output that can be written, got Broken pipe. Let its reader read to the "
              "end.\n");
    EXPECT_EQ(ended.out, "t,level_mean,level_sd,ess,log_evidence\n");
  }
  scratch.shell("{ mote simulate ungm --steps 100000 --out - --truth t.csv; echo $? >code; } | head -1");
  EXPECT_EQ(scratch.read("code"), "6\n");
  EXPECT_EQ(scratch.files().size(), 2U) << "no truth without its recording";
}

TEST(Outputs, ReplaceAFileWholeAndKeepItsMode) {
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1100\n");
  for (const std::string mode : {"640", "664", "600", "644"}) {
    scratch.write("e.csv", "old");
    const Ended ended =
        scratch.shell("umask 022; chmod " + mode +
                      " e.csv && ln -sf e.csv link.csv && mote run local-level --data d.csv --out "
                      "link.csv --summary s.json >/dev/null && stat -c %a e.csv s.json && test -L link.csv");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, mode + "\n644\n");
    EXPECT_TRUE(scratch.read("e.csv").starts_with("t,level_mean"));
  }
}

TEST(Outputs, FollowALinkThatLeadsToNothingYet) {
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1100\n");
  const Ended ended = scratch.shell(
      "mkdir f; ln -s f/new.csv a; ln -s a b; mote run local-level --data d.csv --out b && test -L a -a -L b");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(slurp(scratch.path() / "f/new.csv").starts_with("t,level_mean"));
}

// Readers of an existing file see the old or the new text, never a part.
TEST(Outputs, AreNeverSeenHalf) {
  const Scratch scratch;
  scratch.write("d.csv", long_recording());
  ASSERT_EQ(scratch.shell("mote run local-level --data d.csv -n 10 --out e.csv").code, 0);
  const std::size_t whole = scratch.read("e.csv").size();
  Child child(scratch, {"run", "local-level", "--data", "d.csv", "-n", "10", "--out", "e.csv"});
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(scratch.read("e.csv").size(), whole);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(child.end().code, 0);
}

TEST(Outputs, NeedPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may do everything";
  const Scratch scratch;
  scratch.write("d.csv", "t,y\n1,1100\n");
  EXPECT_EQ(scratch.shell("mkdir f; chmod 500 f; mote run local-level --data d.csv --out f/e.csv").code, 6);
  EXPECT_EQ(scratch.shell("touch e.csv; chmod 400 e.csv; mote run local-level --data d.csv --out e.csv").code, 6);
  EXPECT_EQ(scratch.shell("chmod 000 d.csv; mote run local-level --data d.csv").code, 3);
}

}  // namespace
}  // namespace mote::testing

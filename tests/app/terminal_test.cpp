// The progress bar: on a terminal only, in one line, gone at the end.

#include <chrono>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

/// All that a run shows on a terminal of so many columns.
std::string shown_on_terminal(const Scratch& scratch, std::vector<std::string> words, int columns, const char* terminal,
                              int* code) {
  winsize size{25, static_cast<unsigned short>(columns), 0, 0};
  int screen = -1;
  const pid_t id = forkpty(&screen, nullptr, nullptr, &size);
  if (id < 0) throw std::runtime_error("forkpty failed");
  if (id == 0) {
    if (chdir(scratch.path().c_str()) != 0) _exit(99);
    setenv("TERM", terminal, 1);
    std::string program = MOTE_PROGRAM;
    std::vector<char*> pointers{program.data()};
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(MOTE_PROGRAM, pointers.data());
    _exit(99);
  }
  std::string shown;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(screen, buffer, sizeof buffer)) > 0;)
    shown.append(buffer, static_cast<std::size_t>(n));
  int status = 0;
  waitpid(id, &status, 0);
  close(screen);
  *code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return shown;
}

/// What stood in the line between two of its clearings, in order.
std::vector<std::string> drawings(const std::string& shown) {
  const std::string clear = "\r\x1b[K";
  std::vector<std::string> all;
  for (std::size_t at = shown.find(clear); at != std::string::npos;) {
    const std::size_t next = shown.find(clear, at + clear.size());
    all.push_back(shown.substr(at + clear.size(), next == std::string::npos ? next : next - at - clear.size()));
    at = next;
  }
  return all;
}

class Terminal : public ::testing::Test {
 protected:
  Terminal() {
    std::string data = "t,y\n";
    for (int t = 1; t <= 2000; ++t) data += std::to_string(t) + ",1000\n";
    scratch_.write("d.csv", data);
  }
  /// What a run shows that is long enough for a bar, which is drawn after .3 s: twice as many particles until it is.
  std::string shown(int columns, const char* terminal = "xterm") {
    for (;;) {
      const auto start = std::chrono::steady_clock::now();
      std::string all = shown_on_terminal(scratch_,
                                          {"run", "local-level", "--data", "d.csv", "-n", std::to_string(particles_),
                                           "--engine", "reference", "--out", "-"},
                                          columns, terminal, &code_);
      if (std::chrono::steady_clock::now() - start > std::chrono::seconds(1)) return all;
      particles_ *= 2;
      if (particles_ > 10'000'000) throw std::runtime_error("the run ends too early:\n" + all);
    }
  }

  Scratch scratch_;
  int particles_ = 5000;
  int code_ = -1;
};

TEST_F(Terminal, ShowsABarThatFitsAndGoes) {
  for (const int columns : {80, 200, 40, 0}) {
    const auto bars = drawings(shown(columns));
    EXPECT_EQ(code_, 0);
    ASSERT_GE(bars.size(), 2U) << "no bar";
    for (std::size_t i = 0; i + 1 < bars.size(); ++i) {
      EXPECT_TRUE(bars[i].starts_with("[")) << bars[i];
      EXPECT_LT(bars[i].size(), columns == 40 ? 40U : 80U) << bars[i];
    }
    EXPECT_TRUE(bars.back().starts_with("t,level_mean")) << "the line is clear before anything else is shown";
  }
}

TEST_F(Terminal, ShowsNothingThatItCannotRedraw) { EXPECT_TRUE(drawings(shown(80, "dumb")).empty()); }

TEST_F(Terminal, ClearsTheBarBeforeARefusal) {
  std::string data = scratch_.read("d.csv");
  scratch_.write("d.csv", data + "2001,1e300\n");
  const auto bars = drawings(shown(80));
  EXPECT_EQ(code_, 4);
  ASSERT_GE(bars.size(), 2U);
  EXPECT_TRUE(bars.back().starts_with("mote run: t = 2001: the filter collapsed")) << bars.back();
}

TEST_F(Terminal, NoTerminalNoBar) {
  Child child(scratch_, {"run", "local-level", "--data", "d.csv", "-n", "5000"});
  const auto end = child.end();
  EXPECT_EQ(end.code, 0);
  EXPECT_EQ(end.err, "");
}

}  // namespace
}  // namespace mote::testing

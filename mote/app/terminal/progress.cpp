#include "mote/app/terminal/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace mote {
namespace {

constexpr std::size_t kMostColumns = 80;

bool can_redraw() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

/// One less than the terminal has, so that no cursor waits in a new line.
std::size_t columns_to_use() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return std::min(kMostColumns, known ? std::size_t{size.ws_col} : kMostColumns) - 1;
}

/// "42 s", "12 min", "3.5 h".
std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

}  // namespace

std::string progress_line(std::size_t done, std::size_t all, double seconds, const std::string& unit,
                          std::size_t columns) {
  constexpr std::size_t kWidth = 24;
  const double share = static_cast<double>(done) / static_cast<double>(all);
  const double rate = static_cast<double>(done) / seconds;
  const auto filled = std::min(kWidth, static_cast<std::size_t>(share * static_cast<double>(kWidth)));
  std::string line;
  for (const std::string& part :
       {fmt::format("[{}{}] {:3.0f} %", std::string(filled, '#'), std::string(kWidth - filled, '.'), 100 * share),
        fmt::format("  {}/{} {}", done, all, unit), fmt::format("  {:.3g}/s", rate),
        fmt::format("  {} left", duration(static_cast<double>(all - done) / rate))}) {
    if (line.size() + part.size() > columns) return line;
    line += part;
  }
  return line;
}

Progress::Progress(std::string unit) : unit_(std::move(unit)), shown_(can_redraw()) {}

Progress::~Progress() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
}

void Progress::update(std::size_t done, std::size_t all) {
  if (!shown_) return;
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100) || now - start_ < std::chrono::milliseconds(300)) return;
  last_ = now;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "\r\x1b[K{}", progress_line(done, all, seconds, unit_, columns_to_use()));
  std::fflush(stderr);
}

}  // namespace mote

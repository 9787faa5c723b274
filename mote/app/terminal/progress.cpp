#include "mote/app/terminal/progress.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace mote {

Progress::Progress(std::string unit) : unit_(std::move(unit)), shown_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::update(std::size_t done, std::size_t all) {
  const auto now = Clock::now();
  if (!shown_ || now - last_ < std::chrono::milliseconds(100) || now - start_ < std::chrono::milliseconds(300)) return;
  last_ = now;
  drawn_ = true;
  constexpr std::size_t kWidth = 30;
  const double share = static_cast<double>(done) / static_cast<double>(all);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / seconds;
  const auto filled = static_cast<std::size_t>(share * kWidth);
  fmt::print(stderr, "\r\x1b[K[{}{}] {:3.0f} %  {}/{} {}  {:.3g} {}/s  {:.0f} s left", std::string(filled, '#'),
             std::string(kWidth - filled, '.'), 100 * share, done, all, unit_, rate, unit_,
             static_cast<double>(all - done) / rate);
  std::fflush(stderr);
}

}  // namespace mote

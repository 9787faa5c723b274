#pragma once
/// A progress bar with rate and time left, on a terminal only.

#include <chrono>
#include <cstddef>
#include <string>

namespace mote {

/// Draws on standard error while it lives and is a terminal; silent otherwise. Redraws at most ten times a second.
class Progress {
 public:
  /// `unit` names what is counted ("steps").
  explicit Progress(std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  void update(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;

  std::string unit_;
  bool shown_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
};

}  // namespace mote

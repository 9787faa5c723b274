#pragma once
/// A progress bar with rate and time left, on a terminal only.

#include <chrono>
#include <cstddef>
#include <string>

namespace mote {

/// The bar as a line of at most `columns` columns: what does not fit is left out from the end.
///
///   [##########....................]  33 %  330/1000 steps  110/s  6 s left
std::string progress_line(std::size_t done, std::size_t all, double seconds, const std::string& unit,
                          std::size_t columns);

/// Draws on standard error while it lives, if that is a terminal that can redraw a line; silent otherwise. Redraws at
/// most ten times a second and leaves no trace.
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

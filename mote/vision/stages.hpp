#pragma once
/// What a particle costs, stage by stage: the times that a design of machines starts from.

#include <chrono>
#include <cstddef>

namespace mote::vision {

/// Sums over all steps; unit s. T_p, T_w and T_d of a particle are a sum over `particles`.
struct StageTimes {
  double propose = 0, weigh = 0, select = 0;
  std::size_t particles = 0;
};

/// Adds the time that it lives to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  Stopwatch(Stopwatch&&) = delete;
  Stopwatch& operator=(Stopwatch&&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mote::vision

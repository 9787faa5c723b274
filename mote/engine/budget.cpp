#include "mote/engine/budget.hpp"

#include <algorithm>
#include <chrono>

namespace mote {
namespace {

constexpr std::size_t kFirst = 1024;  // the number to begin with
constexpr std::size_t kUnit = 64;
constexpr double kLongestStride = 8;  // from one number to the next
constexpr double kReserve = 0.95;     // of the budget that is aimed at
constexpr double kNear = 1.1;         // a budget over the time taken that is not worth another trial
constexpr int kMostTrials = 8;

std::size_t times(std::size_t n, double factor, std::size_t least, std::size_t most) {
  const auto product = static_cast<std::size_t>(static_cast<double>(n) * factor);
  return std::clamp(product / kUnit * kUnit, least, most);
}

}  // namespace

Affordable affordable(double seconds, std::size_t least, std::size_t most, const StepClock& clock) {
  Affordable best;
  std::size_t n = std::clamp(kFirst, least, most);
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const double taken = clock(n);
    const double room = seconds / taken;
    if (room >= 1 && n > best.particles) best = {n, taken, true};
    if (n == (room >= 1 ? most : least) || (room >= 1 && room < kNear)) break;
    const std::size_t next = times(n, std::min(kLongestStride, kReserve * room), least, most);
    if (next <= best.particles) break;
    n = next;
  }
  if (best.particles > 0) return best;
  const double taken = clock(least);
  return {least, taken, taken <= seconds};
}

void PilotClock::go_along(Filter& filter, std::vector<double>& seconds) const {
  Step t = 0;
  for (const ObservedStep& step : recording_->steps) {
    if (seconds.size() == steps_) return;
    const auto start = std::chrono::steady_clock::now();
    ++t;
    StepReport report = step.rows.empty() ? filter.predict(t) : filter.update(t, step.rows);
    for (std::size_t d = 0; d < states_.size(); ++d) filter.moments(d, states_[d].angle);
    if (!step.rows.empty()) filter.select(t, report);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
}

double PilotClock::operator()(std::size_t particles) const {
  std::vector<double> seconds;
  while (seconds.size() < steps_) go_along(*make_(particles), seconds);
  const auto ninth = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() * 9 / 10);
  std::nth_element(seconds.begin(), ninth, seconds.end());
  return *ninth;
}

}  // namespace mote

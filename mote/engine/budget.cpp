#include "mote/engine/budget.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "mote/filter/adaptive.hpp"

namespace mote {
namespace {

constexpr std::size_t kFirst = 1024;  // the number to begin with
constexpr double kLongestStride = 8;  // from one number to the next
constexpr double kReserve = 0.95;     // of the budget that is aimed at
constexpr double kNear = 1.1;         // a budget over the time taken that is not worth another trial
constexpr int kMostTrials = 8;

std::size_t times(std::size_t n, double factor, std::size_t least, std::size_t most) {
  const auto product = static_cast<std::size_t>(static_cast<double>(n) * factor);
  return std::clamp(product / kWholeLanes * kWholeLanes, least, most);
}

}  // namespace

Affordable affordable(double seconds, std::size_t least, std::size_t most, const StepClock& clock) {
  Affordable found{least, kNaN, false};
  std::size_t n = std::clamp(kFirst, least, most);
  for (int trial = 1; trial <= kMostTrials; ++trial) {
    if (trial == kMostTrials && !found.fits) n = least;
    const double taken = clock(n);
    const double room = seconds / taken;
    const bool fits = room >= 1;
    if (fits && n >= found.particles) found = {n, taken, true};
    if (n == least && !found.fits) return {least, taken, false};
    if (fits && (n == most || room < kNear)) break;
    const std::size_t next = times(n, std::min(kLongestStride, kReserve * room), least, most);
    if (found.fits && next <= found.particles) break;
    n = next;
  }
  return found;
}

double PilotClock::operator()(std::size_t particles) const {
  using Clock = std::chrono::steady_clock;
  const auto told_to_stop = [&] { return request_.stop != nullptr && request_.stop->load(); };
  std::vector<double> seconds;
  std::atomic<bool> enough = false;
  Clock::time_point start;
  RunRequest request = request_;
  request.dump = nullptr;
  request.checkpoint = nullptr;
  request.stop = &enough;
  request.progress = [&](std::size_t, std::size_t) {
    const Clock::time_point now = Clock::now();
    seconds.push_back(std::chrono::duration<double>(now - start).count());
    start = now;
    enough = seconds.size() == steps_ || told_to_stop();
  };
  Plan plan = plan_;
  plan.particles = particles;
  plan.on_collapse = OnCollapse::kKeep;  // which ends the run itself, not a trial
  while (!enough) {
    const auto filter = make_(plan);
    start = Clock::now();
    run(*filter, plan, *recording_, request);
  }
  if (told_to_stop()) return kInfinity;
  const auto ninth = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() * 9 / 10);
  std::nth_element(seconds.begin(), ninth, seconds.end());
  return *ninth;
}

}  // namespace mote

#pragma once
/// How many particles a step's time allows, by measurement.

#include <functional>
#include <memory>

#include "mote/engine/recording.hpp"
#include "mote/filter/filter.hpp"

namespace mote {

/// What a budget of time allows.
struct Affordable {
  std::size_t particles = 0;
  double step_seconds = 0;  ///< that nine of ten steps with so many kept within
  bool fits = true;         ///< false: even the least number takes longer
};

/// Says what a step with so many particles takes, in seconds.
using StepClock = std::function<double(std::size_t particles)>;

/// The largest number of particles, a multiple of 64 but for its bounds, whose steps keep within a budget.
///
/// Times are asked for some numbers, each of which follows from the time of the one before; at most eight of them.
///
/// shape   1 <= least <= most
Affordable affordable(double seconds, std::size_t least, std::size_t most, const StepClock& clock);

/// A clock that runs filters along a recording, estimates included: the 0.9 quantile of some steps' times.
///
/// shape   steps >= 1; a recording that is shorter is gone along again by a new filter
class PilotClock {
 public:
  using Make = std::function<std::unique_ptr<Filter>(std::size_t particles)>;

  PilotClock(Make make, const Recording& recording, std::vector<Quantity> states, std::size_t steps)
      : make_(std::move(make)), recording_(&recording), states_(std::move(states)), steps_(steps) {}

  double operator()(std::size_t particles) const;

 private:
  void go_along(Filter& filter, std::vector<double>& seconds) const;

  Make make_;
  const Recording* recording_;
  std::vector<Quantity> states_;
  std::size_t steps_;
};

}  // namespace mote

#pragma once
/// How many particles a step's time allows, by measurement.

#include <functional>
#include <memory>

#include "mote/engine/run.hpp"
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

/// A clock that runs filters along a recording as a run does, estimates included: the 0.9 quantile of some steps'
/// times; infinity when the run is told to stop.
///
/// shape   steps >= 1; a recording that is shorter, but not empty, is gone along again by a new filter
class PilotClock {
 public:
  /// Makes a filter of the plan, which has the number of particles to be tried.
  using Make = std::function<std::unique_ptr<Filter>(const Plan& plan)>;

  PilotClock(Make make, const Recording& recording, Plan plan, RunRequest request, std::size_t steps)
      : make_(std::move(make)),
        recording_(&recording),
        plan_(std::move(plan)),
        request_(std::move(request)),
        steps_(steps) {}

  double operator()(std::size_t particles) const;

 private:
  Make make_;
  const Recording* recording_;
  Plan plan_;
  RunRequest request_;
  std::size_t steps_;
};

}  // namespace mote

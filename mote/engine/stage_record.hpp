#pragma once
/// What the stages of a pipeline did: how busy each of their workers was, what waited before them, and a timeline.

#include <cstdint>
#include <string>
#include <vector>

#include "mote/base/numbers.hpp"

namespace mote {

/// One worker of a stage.
struct StageWorker {
  double busy_seconds = 0;
  std::uint64_t blocks = 0;  ///< that it worked on
};

/// One stage.
struct StageUse {
  std::string name;  ///< propose, weigh or chain
  std::vector<StageWorker> workers;
  double mean_queue = 0;          ///< blocks that waited for the stage when it took one up, that one included
  std::size_t largest_queue = 0;  ///< likewise; 0 for the first stage, which nothing waits for
};

/// A worker at work on a block.
struct StageSpan {
  std::size_t stage, worker;  ///< of StageRecord::stages; `stage` past the last: all stages wait for one thread
  double begin, end;          ///< seconds after the timeline's begin
};

/// The stages of a run.
struct StageRecord {
  std::size_t threads = 0;
  double seconds = 0;          ///< in which the stages were at work
  double barrier_seconds = 0;  ///< in which they waited for what a step does once: sums, resampling, gathering
  std::vector<StageUse> stages;
  std::vector<Step> timeline_steps;  ///< steps that the timeline shows, one after the other
  std::vector<StageSpan> timeline;
};

/// A filter that is run by stages.
class Staged {
 public:
  virtual ~Staged() = default;
  virtual StageRecord stages() const = 0;

 protected:
  Staged() = default;
  Staged(const Staged&) = default;
  Staged(Staged&&) = default;
  Staged& operator=(const Staged&) = default;
  Staged& operator=(Staged&&) = default;
};

}  // namespace mote

#pragma once
/// Checkpoint: a run's state between steps, so that a run that was broken off goes on as if it had not been.

#include <functional>

#include "mote/base/archive.hpp"
#include "mote/engine/run_record.hpp"

namespace mote {

/// How far a run is.
struct RunState {
  Step t = 0;        ///< steps of the model that are done
  RunRecord record;  ///< estimates so far

  /// Writes or reads the time, the rows and the time that they took.
  void keep(Archive& archive);
};

/// Writes or reads all of a run that lasts from step to step.
using KeepRun = std::function<void(Archive&)>;

/// A place where a run is kept.
class Checkpoint {
 public:
  virtual ~Checkpoint() = default;

  /// Before the first step: has the run read what is kept, if anything is. Returns whether it was.
  virtual bool resume(const KeepRun& run) = 0;
  /// After every step: has the run write itself, if it is time to.
  virtual void step_done(const KeepRun& run) = 0;
  /// When the run is told to stop: has it write itself.
  virtual void stopped(const KeepRun& run) = 0;

 protected:
  Checkpoint() = default;
  Checkpoint(const Checkpoint&) = default;
  Checkpoint(Checkpoint&&) = default;
  Checkpoint& operator=(const Checkpoint&) = default;
  Checkpoint& operator=(Checkpoint&&) = default;
};

}  // namespace mote

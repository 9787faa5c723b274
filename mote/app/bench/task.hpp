#pragma once
/// Tasks of `mote bench`: who does what, whose answer is right, what a particle-step moves.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mote/base/numbers.hpp"
#include "mote/engine/stage_record.hpp"

namespace mote::bench {

/// One who does a task.
class Racer {
 public:
  virtual ~Racer() = default;
  /// Makes ready: memory, seeds, the prior. Not timed.
  virtual void prepare(std::size_t particles, std::uint64_t seed) = 0;
  /// Does the task; timed. Every run follows a prepare() of its own.
  virtual void run(std::vector<double>& answer) = 0;
  /// Seconds of the last run where it was timed by a program outside, or by the racer itself; NaN: by the race.
  virtual double outside_seconds() const { return kNaN; }
  /// Bytes of memory that a program outside took for it; NaN: it ran in here.
  virtual double outside_bytes() const { return kNaN; }
  /// What the stages of its last run did, if it ran by stages.
  virtual std::optional<StageRecord> stages() const { return std::nullopt; }

 protected:
  Racer() = default;
  Racer(const Racer&) = default;
  Racer(Racer&&) = default;
  Racer& operator=(const Racer&) = default;
  Racer& operator=(Racer&&) = default;
};

/// Who takes part.
struct Entrant {
  std::string name, meaning;
  double bytes;         ///< read and written at least per particle-step once the particles outgrow the caches; derived
  std::string why_not;  ///< why it cannot run here; empty: it can
  std::function<std::unique_ptr<Racer>()> make;
  std::function<double(std::size_t particles)> predicted = {};  ///< seconds of a run, by a law; empty: none says
};

/// How an answer was judged: right if low <= value <= high.
struct Verdict {
  std::string measure;  ///< "RMSE to the exact mean over 20 runs of 1000 particles"
  double value, low, high;
  bool right() const { return low <= value && value <= high; }
};

enum class Clock {
  kThread,  ///< CPU time of the one thread that works: what else the machine does counts little
  kWall,    ///< what a user waits
};

/// One task.
struct Task {
  std::string name, meaning;
  Clock clock = Clock::kThread;
  std::size_t steps = 1;  ///< a run of N particles is N x steps particle-steps
  /// The first is whom the others are measured against; one called "limit" is what all are measured against, too.
  std::vector<Entrant> entrants;
  std::function<Verdict(const Entrant&)> judge;
  /// Where a particle costs much: larger numbers of particles that are asked for are brought down to this, and a run is
  /// not repeated within a turn. 0: as many as are asked for.
  std::size_t most_particles = 0;
  std::size_t least_particles = 1;  ///< smaller numbers of particles that are asked for are brought up to this
};

/// A task by its name and what it is about; made only when asked for, since making one may draw recordings.
struct TaskEntry {
  std::string name, meaning;
  Task (*make)(const TaskEntry& entry, std::size_t threads);
};

/// All tasks, in the order they are run.
const std::vector<TaskEntry>& tasks();

}  // namespace mote::bench

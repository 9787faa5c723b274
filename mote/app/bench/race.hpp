#pragma once
/// Races: the entrants of a task, first checked, then timed in turns.

#include <atomic>

#include "mote/app/bench/task.hpp"
#include "mote/app/compare/statistics.hpp"

namespace mote::bench {

/// Median with quartiles.
struct Spread {
  double median, low, high;
};

/// A ratio of times from paired rounds, its 95 % interval by the bootstrap of rounds.
struct Ratio {
  double value;
  compare::Interval interval;
};

/// What came of one entrant at one number of particles.
struct Result {
  std::string entrant;
  std::size_t particles;
  std::vector<double> rounds;  ///< ns per particle-step, by round
  Spread ns;                   ///< of those
  double bytes;                ///< moved per particle-step, derived
  double memory;               ///< bytes the entrant holds, measured after a run; NaN where nobody says
  Ratio to_first;              ///< its time over that of the task's first entrant
  Ratio of_limit;           ///< the limit's time over its own: 1 = as fast as the hardware allows; NaN without a limit
  double predicted = kNaN;  ///< ns per particle-step, by its law; NaN without one
  Ratio to_predicted{kNaN, {kNaN, kNaN}};  ///< its time over that
};

/// An entrant that did not take part.
struct Absent {
  std::string entrant, why;
};

/// An entrant with the verdict on its answer.
struct Checked {
  std::string entrant;
  Verdict verdict;
};

/// What came of a task.
struct Outcome {
  std::string task, meaning;
  Clock clock;
  std::size_t steps;
  std::vector<Checked> checks;
  std::vector<Absent> absent;
  std::vector<Result> results;                              ///< by particles, then by entrant
  std::vector<std::pair<std::string, StageRecord>> stages;  ///< of those who run by stages, at the first number
};

/// How to race.
struct Rules {
  std::string where;  ///< opens a refusal
  std::vector<std::size_t> particles;
  std::size_t repeats;  ///< rounds
  std::function<void(std::size_t done, std::size_t all)> progress;
  const std::atomic<bool>& stop;
};

/// Median and quartiles, the quartiles by linear interpolation between the sorted values.
///
/// shape   values: (n,), n >= 1
Spread spread_of(std::vector<double> values);

/// Median of above[r] / below[r] over the rounds r.
///
/// shape   above, below: (n,), n >= 1
/// error   none; NaN ends of the interval for n = 1
Ratio paired_ratio(std::span<const double> above, std::span<const double> below);

/// Judges every entrant, then times those that can run in turns: A B C A B C ..., after a run of each to warm up. A run
/// shorter than 200 000 particle-steps is repeated within its turn up to that many.
///
/// error   Refusal (exit code 1) when an answer is wrong: nothing is timed; Refusal (kInterrupted) on the stop flag
Outcome race(const Task& task, const Rules& rules);

}  // namespace mote::bench

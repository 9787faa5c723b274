#pragma once
/// Run: a filter along a recording.

#include <atomic>
#include <functional>

#include "mote/engine/checkpoint.hpp"
#include "mote/engine/estimand.hpp"
#include "mote/engine/run_record.hpp"

namespace mote {

/// What a run is told besides its filter and data.
struct RunRequest {
  std::string where = "run";  ///< opens a refusal: the command, or the item that asked
  std::vector<Quantity> states;
  std::vector<ValueSource> sources;
  std::vector<Estimand> estimands;
  std::function<void(std::size_t done, std::size_t all)> progress = [](std::size_t, std::size_t) {
  };                                                   ///< rows of the data
  std::function<void(Step, const WeightedSet&)> dump;  ///< empty: no dump
  const std::atomic<bool>* stop = nullptr;             ///< set by a signal
  Checkpoint* checkpoint = nullptr;                    ///< where the run is kept between steps
};

/// Filters a recording: predicts across gaps, updates by each step's rows, estimates before selection.
///
///   the first row at t = k predicts k times from x_0; a step without observation is predicted only
///
/// A run with a checkpoint goes on where the one that was kept there ended; its record is that of an unbroken run but
/// for the times.
///
/// error   Refusal (kCollapsed) when a step collapses and the plan says stop; what the checkpoint throws
RunRecord run(Filter& filter, const Plan& plan, const Recording& recording, const RunRequest& request);

}  // namespace mote

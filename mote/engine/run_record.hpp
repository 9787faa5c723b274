#pragma once
/// What a run leaves: estimates by step, and the figures that sum it up.

#include <optional>
#include <string>
#include <vector>

#include "mote/engine/plan.hpp"
#include "mote/engine/recording.hpp"
#include "mote/engine/stage_record.hpp"
#include "mote/filter/estimate.hpp"
#include "mote/filter/filter.hpp"

namespace mote {

/// The estimates of one step.
struct EstimateRow {
  Step t;
  std::vector<Moments> states;    ///< (D,)
  std::vector<double> functions;  ///< in the order of RunRecord::function_labels
  StepReport report;
};

/// A run, ready to be written, plotted or compared.
struct RunRecord {
  std::string model, engine;
  Plan plan;
  std::vector<Quantity> states;
  std::vector<std::string> function_labels;
  std::vector<EstimateRow> rows;
  std::size_t predicted_steps = 0;    ///< steps of the model, gaps included
  double step_seconds = 0;            ///< time in stepping and estimating
  double wall_seconds = 0;            ///< time of the whole run, reading included, before the files are written
  std::optional<StageRecord> stages;  ///< of a filter that is run by stages: what they did since the run went on
  bool interrupted = false;           ///< ended before the data by a signal
};

/// Mean, median and root mean square of the distance between estimated and true position.
struct PositionError {
  double mean, median, rmse;
};

/// The figures of a run.
struct Summary {
  double log_evidence;  ///< sum of the increments; -infinity after a collapse
  double mean_ess;
  double acceptance;         ///< mean over steps with a chain; NaN without
  double mean_burn_in;       ///< mean N_b over steps with a chain; NaN without
  Traffic traffic_per_step;  ///< mean over the estimated steps; of chains, what sharing their parents takes
  std::size_t collapses;
  double ns_per_particle_step;
  std::vector<double> rmse;                     ///< by state, NaN where the truth does not say; empty without truth
  std::optional<PositionError> position_error;  ///< models with states x and y, when the truth has both
};

/// Sums a run up, against the truth when there is one; angles by their wrapped difference.
Summary summarise(const RunRecord& record, const Truth* truth);

}  // namespace mote

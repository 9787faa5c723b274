#pragma once
/// --budget: as accurate as so much time a step allows.

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/filter/adaptive.hpp"

namespace mote {

/// What a run is told of its time, and what that came to.
struct Budget {
  std::optional<double> seconds;  ///< of a step; empty: the most particles are told
  AdaptiveOptions adaptive;
  double step_seconds = kNaN;  ///< that steps with the most took when they were tried
  bool fits = true;            ///< false: even the least take longer
};

std::vector<OptionSpec> budget_options();

/// The budget that is asked for, if one is; the plan is then as large as it may become.
///
/// error   Refusal (kWrongUse): no time, a filter or engine whose number of particles stays, what contradicts it
std::optional<Budget> budget_from(const Arguments& arguments, Plan& plan);

/// Tries how many particles the time allows a run of the request, if none are told, and sets the plan's.
///
/// error   Refusal (kWrongUse): bins for another number of states
void settle(Budget& budget, const Job& job, const RunRequest& request, Plan& plan);

/// A filter of the plan whose number of particles follows its weights.
std::unique_ptr<AdaptiveFilter> adaptive_filter(const Budget& budget, const Job& job, const Plan& plan,
                                                const std::string& where);

/// seconds, most_particles, least_particles, mc_error, step_seconds, fits (null: nothing was tried), particles {least,
/// mean, most}, replay.
nlohmann::json budget_json(const Budget& budget, const ParticleCounts& counts);

/// The same as a line.
std::string budget_text(const Budget& budget, const ParticleCounts& counts);

}  // namespace mote

#pragma once
/// `mote simulate-cluster`, for those who want its sweeps.

#include "mote/app/commands/command.hpp"
#include "mote/app/simulated/publication.hpp"

namespace mote {

/// Its options.
std::vector<OptionSpec> simulate_cluster_options();

/// The sweep of a command line, checked, not yet run.
///
/// error   Refusal (kWrongUse, kBadData) for what it cannot be
simulated::Sweep sweep_from(const Arguments& arguments);

/// Measures what is to be measured, and runs the sweep; `progress` is told after every setting how many there are.
///
/// error   Refusal (kOutsideTool) when SimGrid is missing or fails
void run_sweep(simulated::Sweep& sweep, const Arguments& arguments, const std::function<void(std::size_t)>& progress);

}  // namespace mote

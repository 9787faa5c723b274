#pragma once
/// The options that keep a run, and what it is known by.

#include <memory>
#include <optional>

#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/files/checkpoint_file.hpp"

namespace mote {

/// --checkpoint and --checkpoint-every.
std::vector<OptionSpec> checkpoint_options();

/// The checkpoint asked for, if one is. Its facts are whatever decides the run's estimates: model and settings, data,
/// options, engine, instruction set.
///
/// error   as CheckpointFile; Refusal (kWrongUse) when it is asked for together with --dump-particles, or an interval
///         without it
std::optional<CheckpointFile> checkpoint_from(const Arguments& arguments, const Plan& plan, const Job& job);

}  // namespace mote

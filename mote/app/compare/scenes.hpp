#pragma once
/// The recordings of a comparison or an exploration, and what errors are measured against: by options that both have.

#include "mote/app/commands/command.hpp"
#include "mote/app/compare/study.hpp"

namespace mote::compare {

/// The most that may be asked for of simulated recordings.
struct SceneBounds {
  long long steps, columns;
};

/// Puts model and recordings into a design, whose model's name, where and seed are read: those of --data and --truth,
/// or simulated ones, by --steps, --recordings, --columns, of seeds S to S + K - 1. Says in words where they are from,
/// and adds notes on columns that nobody reads.
///
/// error   Refusal (kWrongUse, kBadData)
std::string find_scenes(const Arguments& arguments, const SceneBounds& bounds, Design& design,
                        std::vector<std::string>& notes);

/// A run that stands for what is not known exactly.
inline const std::string kLargeRun = "sisr -n 200000";

/// The exact means, or where none are known those of kLargeRun.
///
/// error   Refusal: kCollapsed, kInterrupted
Reference usual_reference(const Design& design, const ProgressOf& progress, const std::atomic<bool>& stop);

}  // namespace mote::compare

#pragma once
/// What `mote design explore` is asked: a model, recordings, a target with its candidates, budgets.

#include "mote/app/commands/command.hpp"
#include "mote/app/explore/search.hpp"

namespace mote::explore {

std::vector<OptionSpec> explore_options();

/// The recordings: the data's, or simulated ones, with their truths; the reference is not known yet.
struct Material {
  compare::Design design;
  std::string source;              ///< in words
  std::vector<std::string> notes;  ///< on columns that nobody reads
};

/// error   Refusal (kWrongUse, kBadData)
Material material_from(const Arguments& arguments);

/// The target with its candidates.
///
/// error   Refusal (kWrongUse) for a target, a kind or a number that there is not; (kOutsideTool) without its tools
std::unique_ptr<Target> target_from(const Arguments& arguments, const Material& material);

/// Limits, goal and effort. Without --minimise the goal is what has no limit, in the order error, time, area or
/// workers, power; with limits on all of them the error.
///
/// error   Refusal (kWrongUse) for a limit on what the target does not have
Order order_from(const Arguments& arguments, const Target& target);

/// What findings depend on: two explorations with the same facts find the same.
///
/// error   as read_text()
RunFacts facts_of(const Arguments& arguments, const Material& material, const Target& target);

}  // namespace mote::explore

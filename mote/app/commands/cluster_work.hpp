#pragma once
/// What the words of `mote simulate-cluster` ask for.

#include "mote/app/commands/command.hpp"
#include "mote/app/simulated/publication.hpp"

namespace mote {

/// The work of a sweep, but for the model's part in it and the times.
///
/// error   Refusal (kWrongUse) for options that do not go together
simulated::Workload work_from(const Arguments& arguments);

/// Fills in which ranks a sweep has, whose platform and work are known, and what depends on them.
///
/// error   Refusal (kWrongUse) for more than the platform, or the filter, has room for
void cast_ranks(const Arguments& arguments, simulated::Sweep& sweep);

/// The numbers of ranks among these that SISR's particles can be shared by: a block of 1024 each.
std::vector<std::size_t> ranks_with_blocks(const simulated::Workload& work, const std::vector<std::size_t>& ranks);

}  // namespace mote

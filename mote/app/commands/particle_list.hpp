#pragma once
/// The option --particles of commands that take several numbers.

#include <vector>

#include "mote/app/commands/command.hpp"

namespace mote {

/// "100,1000" in growing order, each once.
///
/// error   Refusal (kWrongUse) for what is no integer from 1 to kMostParticles
std::vector<std::size_t> particle_list_from(const Arguments& arguments);

}  // namespace mote

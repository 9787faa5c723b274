#pragma once
/// Options that take several numbers; --particles is one of several commands.

#include <vector>

#include "mote/app/commands/command.hpp"

namespace mote {

/// An option's integers, "1,2,4", in growing order, each once; `example` is what a refusal proposes.
///
/// error   Refusal (kWrongUse) for what is no integer from least to most
std::vector<long long> integer_list_from(const Arguments& arguments, const std::string& option, long long least,
                                         long long most, const std::string& example);

/// "100,1000" in growing order, each once.
///
/// error   Refusal (kWrongUse) for what is no integer from 1 to kMostParticles
std::vector<std::size_t> particle_list_from(const Arguments& arguments);

}  // namespace mote

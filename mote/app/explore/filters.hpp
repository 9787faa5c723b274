#pragma once
/// Candidate filters in software: what processors and clusters have in common.

#include <string>
#include <vector>

#include "mote/app/explore/target.hpp"

namespace mote::explore {

/// The filters that a processor's candidates are made of, as options of `mote run`: kinds, chains, groups, and every
/// proposal of the model.
///
/// error   Refusal (kWrongUse) for a kind that there is not
std::vector<std::string> filters_of(const Space& space);

/// "--filter imh --improved" as words.
Words words_in(const std::string& text);

/// A run of a plan on its threads; its seed is the plan's.
///
/// error   Refusal (kCollapsed)
RunRecord run_planned(const Space& space, const Plan& plan, const Recording& recording);

/// A run on one thread, on which results never depend.
RunRecord run_alone(const Space& space, Plan plan, const Recording& recording, std::uint64_t seed);

/// The command line of `mote run` for a candidate's words.
std::string run_command_of(const Space& space, const Words& words, const std::string& data);

}  // namespace mote::explore

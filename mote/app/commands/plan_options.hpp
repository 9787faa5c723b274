#pragma once
/// The options that make a plan: shared by every command that runs a filter.

#include <vector>

#include "mote/app/commands/command.hpp"
#include "mote/engine/plan.hpp"

namespace mote {

/// Options of filters, in the order of the help.
std::vector<OptionSpec> plan_options();

/// The plan that the options ask for, checked.
///
/// error   Refusal (kWrongUse) naming the option; what this version does not have yet is refused by name
Plan plan_from(const Arguments& arguments);

/// What the options say of the exchange between groups: --exchange, --exchange-count, --topology and --exchange-every.
inline const std::vector<std::string> kExchangeOptions{"--exchange", "--exchange-count", "--topology",
                                                       "--exchange-every"};
GroupOptions exchange_from(const Arguments& arguments);

/// A line for every option that was given and that the plan's filter does not read.
std::vector<std::string> notes_on_unread(const Arguments& arguments, const Plan& plan);

}  // namespace mote

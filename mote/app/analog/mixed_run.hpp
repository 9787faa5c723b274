#pragma once
/// Runs in mixed mode: the options of a design, and the filter that they make.

#include <memory>
#include <string>
#include <vector>

#include "mote/analog/mixed_filter.hpp"
#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/command.hpp"

namespace mote {

/// The options of a mixed-mode design, for whatever runs one beside the options of a plan.
std::vector<OptionSpec> mixed_options();

/// These and the options of a plan.
std::vector<OptionSpec> mixed_run_options();

/// The design that the options ask for, its circuits simulated. Without --analog it has those that the model has a use
/// for, at the currents of MIXED, Table III.
///
/// error   Refusal (kWrongUse) naming the option; Refusal (kOutsideTool) where a simulation is not to be had
analog::Design design_from(const Arguments& arguments, const CatalogueModel& model);

/// The filter of a plan with the design's analog parts; another seed of the plan gives other noise in the same parts.
std::unique_ptr<Filter> mixed_filter(const CatalogueModel& model, const Plan& plan, const analog::Design& design,
                                     const std::string& where);

/// "Method-1: arctan, realistic, I_a 10 nA; ...; DAC 10 bits, ADC 8 bits".
std::string words_of(const analog::Design& design);

}  // namespace mote

#pragma once
/// What `mote design optimise` is asked: a demand, whose laws, and how the exact schedule plays.

#include <vector>

#include "mote/app/commands/command.hpp"
#include "mote/design/integers.hpp"

namespace mote {

struct DesignRequest {
  design::Demand demand;
  design::Print print = design::Print::kCorrected;
  std::size_t queue = 0;  ///< of the exact schedule, as its messages
  design::Message message;
};

/// The options of the demand.
std::vector<OptionSpec> design_options();

/// error   Refusal (kWrongUse) for a number out of range, or a limit on energy that blocks do not take
DesignRequest design_request_from(const Arguments& arguments);

}  // namespace mote

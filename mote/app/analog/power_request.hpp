#pragma once
/// What `mote analog power` is asked.

#include <optional>
#include <string>
#include <vector>

#include "mote/analog/budget.hpp"
#include "mote/app/commands/command.hpp"

namespace mote {

/// A circuit that others made: what its filter takes and how many particles it handles.
struct OtherCircuit {
  std::string name;
  double rate_hz = 0, power_w = 0;
};

struct PowerRequest {
  analog::Load load;
  double ia_arctan_a = 0, ia_gaussian_a = 0;
  bool simulated = false;  ///< the circuits' power is ngspice's, not the printed one
  double mac_w = 0;        ///< P
  int particles = 1000;    ///< of a step
  std::vector<OtherCircuit> others;
};

std::vector<OptionSpec> power_options();

/// error   Refusal (kWrongUse) for numbers out of range; Refusal (kBadData) for a --fpga file without figures; Refusal
///         (kOutsideTool) where circuits are to be simulated and ngspice is missing
PowerRequest power_request_from(const Arguments& arguments);

}  // namespace mote

#pragma once
/// The options of a circuit: the same for the command that writes it and for items that have one.

#include <optional>
#include <vector>

#include "mote/app/circuits/circuit.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/hardware/machine/cost.hpp"

namespace mote {

/// Those that say what the circuit is, and for which device it is synthesised.
std::vector<OptionSpec> circuit_options();

/// error   Refusal (kWrongUse): an unknown kind, a number out of range, an option that the kind has no register for
CircuitDesign circuit_design_from(const Arguments& arguments);

/// The family of --synth; nothing without it.
std::optional<hardware::Family> family_from(const Arguments& arguments);

}  // namespace mote

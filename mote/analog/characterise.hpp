#pragma once
/// From a circuit to a behaviour: simulate, judge, fit.

#include "mote/analog/behaviour.hpp"

namespace mote::analog {

/// What a circuit is simulated under.
struct Conditions {
  double temperature_c = 27;
  double supply_v = 3;
};

/// The behaviour of a circuit, fitted to a simulation that is made now.
///
/// error   Refusal (kOutsideTool) when ngspice is missing or finds no solution; Refusal (kWrongUse) for an I_a, a
/// temperature or a supply that no such circuit works at
/// cost    half a second to some seconds
Behaviour characterised(Function function, double ia_a, Level level, const Conditions& conditions = {});

}  // namespace mote::analog

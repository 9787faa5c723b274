#pragma once
/// Simulations of a circuit: its transfer, its power, its currents and how fast it settles.

#include <map>
#include <string>
#include <vector>

#include "mote/analog/netlist.hpp"

namespace mote::analog {

/// A circuit over its input, the least first.
struct Sweep {
  std::vector<double> x;        ///< I_in / I_a
  std::vector<double> y;        ///< I_out / I_a
  std::vector<double> power_w;  ///< of the supply; a current into the input comes from it too
  std::map<std::string, std::vector<double>> current_a = {};  ///< of the devices that were asked for
  std::map<std::string, std::vector<double>> voltage_v = {};  ///< of the nodes
};

/// What of a circuit is noted, beside its output and its power.
struct Watch {
  std::vector<std::string> devices = {}, nodes = {};
};

/// Steady states for x from -kRange to kRange in 2 `half` equal steps; with `between`, at the middles of these steps.
///
/// Both halves start about x = 0, where the solution is known to the solver. The output is held against
/// approximation(): one that is farther than 0.5 off is another solution of the equations, not the circuit's.
///
/// error   Refusal (kWrongUse) for an I_a, a temperature or a supply out of range; Refusal (kOutsideTool) when ngspice
/// is
///         missing, finds no solution, or another
/// cost    about 0.3 ms a point
Sweep swept(const Translinear& circuit, const Setting& setting, std::size_t half, bool between = false,
            const Watch& watch = {});

/// Seconds until y is within 1/512 of its end after x went from 0 to `step`, or back: the longer of the two.
///
/// error   as swept()
/// cost    about 0.1 s
double settling_time(const Translinear& circuit, const Setting& setting, double step);

/// Refuses I_a, temperature or supply that no such circuit works at (Refusal, kWrongUse): 0.01 to 100 nA, -40 to 125 C,
/// 2.5 to 5.5 V.
void refuse_absurd(const Setting& setting);

}  // namespace mote::analog

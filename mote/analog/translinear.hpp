#pragma once
/// Circuits as loops of translinear elements: what is connected with what, before there is any transistor.

#include <array>
#include <string>
#include <vector>

#include "mote/analog/behaviour.hpp"

namespace mote::analog {

/// A multiple-input translinear element: two gates, a drain, its source at ground.
///
///   I = width I_s exp(kappa (V_1 + V_2) / U_T) from its drain to ground; no current into the gates
struct Mite {
  std::string name, drain;
  std::array<std::string, 2> gates;
  double width = 1;
};

/// A current of `times` I_a from the supply into a node, copied from the reference.
struct Bias {
  std::string node;
  double times;
};

/// What is drawn out of the node `from` comes from the supply, and `ratio` times as much flows into `to`.
struct Mirror {
  std::string from, to;
  double ratio = 1;
};

/// A circuit. A current I_in flows into the node `input`, I_out out of the node `output`.
struct Translinear {
  Function function;
  std::vector<Mite> mites;
  std::vector<Bias> biases;
  std::vector<Mirror> mirrors;
  std::string input, output;
};

/// The circuit of a function, for currents of both signs (docs/analog.md has the derivation).
///
/// A splitter makes x+ - x- = x with x+ x- = c, both positive; then x+^2 + x-^2 = x^2 + 2c, in units of I_a:
///
///   arctan    y = (pi/2) (x+ - x-) / (0.63 + sqrt(x+^2 + x-^2)),       c = 0.44: the 0.88 of the formula
///   gaussian  y = 1 / (b (x+^2 + x-^2)^2 + d),                         c = a/4b, d = 1 - a^2/4b
Translinear translinear(Function function);

/// What the circuit computes by the ideal law:
///
///   arctan    (pi/2) x / (0.63 + sqrt(0.88 + x^2))                     within 0.08 % of 1 rad
///   gaussian  1 / (1 + a x^2 + b x^4),   a = 0.5684, b = 0.15          within 5.2 %, 2.1 % rms
double approximation(Function function, double x);

/// The translinear identities of a circuit: integers c, one a MITE, such that the gate voltages cancel and
///
///   product over k of (I_k / (width_k I_s))^c_k = 1
///
/// shape   a basis: as many as there are MITEs above the rank of their gates
std::vector<std::vector<int>> loops(const Translinear& circuit);

/// Every device whose current may deviate, in the order of draws: the MITEs by name, "reference", "bias.<node>",
/// "in.<node>" and "out.<node>" of the mirror at a node.
std::vector<std::string> devices(const Translinear& circuit);

}  // namespace mote::analog

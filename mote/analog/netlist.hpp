#pragma once
/// A circuit of translinear elements as lines of SPICE.

#include <string>
#include <vector>

#include "mote/analog/technology.hpp"
#include "mote/analog/translinear.hpp"

namespace mote::analog {

/// What of a circuit is simulated.
struct Setting {
  Level level = Level::kRealistic;
  double ia_a = 10e-9;
  Conditions conditions = {};
  std::vector<double> deviations = {};  ///< of ln I, one a device in the order of devices(); empty: none
};

/// How the input goes: constant, for a sweep; or 0, then `step` I_a from `length_s` on, then 0 again from twice that
/// on.
struct Input {
  double step = 0, length_s = 0;
};

/// The circuit with its supply, its reference, its capacitances and its load, a next stage that holds the output at
/// a voltage. Sources: "iin" is the input, "vdd" the supply, "vout" senses the output; nodes by their names in the
/// circuit, with "_" for "."; a device's current is that of "b" and its name.
///
/// By the realistic level   I = width I_spec ln^2(1 + exp(v/2)) (1 - exp(-V_ds / U_T)) (1 + V_ds / V_early),
///                          v = kappa (V_1 + V_2) / U_T + ln(I_s / I_spec)
/// (the interpolation of Enz, Krummenacher & Vittoz 1995); by the ideal one the law of a MITE, and perfect mirrors.
///
/// shape   without the closing ".end"
std::vector<std::string> netlist(const Translinear& circuit, const Setting& setting, const Input& input = {});

/// The name of a device's source in a netlist: "bplus_square".
std::string source_name(const std::string& device);

}  // namespace mote::analog

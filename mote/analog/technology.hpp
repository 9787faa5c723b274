#pragma once
/// The transistors of a 0.5 um CMOS process: what the netlists are made of.

#include "mote/analog/behaviour.hpp"

namespace mote::analog {

/// What a circuit is simulated under.
struct Conditions {
  double temperature_c = 27;
  double supply_v = 3;
  bool trimmed = true;  ///< floating gates programmed after fabrication; else devices differ as they were made
};

/// A MITE of width 1, or a transistor of a mirror. The paper names the process (AMI 0.5 um) and no size; what is chosen
/// and why is in docs/analog.md.
struct Transistor {
  double kappa;             ///< of a gate: dV_channel / dV_gate, with the capacitive divider of a MITE's inputs
  double specific_a;        ///< 2 n beta U_T^2 at 27 C: where weak inversion ends
  double preexponential_a;  ///< I_s at 27 C: set by the charge on the floating gate, or by the threshold
  double early_v;           ///< output resistance I_early / I, with its cascode
  double gate_f;            ///< capacitance that a gate puts on its node
  double area_um2;          ///< of its channel
  double vt_mv_um;          ///< Pelgrom: sd of the threshold, times the root of the area
  double beta_percent_um;   ///< likewise of the current factor
};

/// 40.5 um / 0.6 um n-channel, two inputs of 42 fF: K' = 116 uA/V^2, n = 1/0.7, C_ox = 2.5 fF/um^2.
inline constexpr Transistor kMite{.kappa = 0.25,
                                  .specific_a = 15e-6,
                                  .preexponential_a = 1e-17,
                                  .early_v = 400,
                                  .gate_f = 27e-15,
                                  .area_um2 = 24,
                                  .vt_mv_um = 11,
                                  .beta_percent_um = 1.9};
/// 83 um / 1.2 um p-channel, K' = 38 uA/V^2.
inline constexpr Transistor kMirror{.kappa = 0.7,
                                    .specific_a = 5e-6,
                                    .preexponential_a = 1e-16,
                                    .early_v = 2500,
                                    .gate_f = 40e-15,
                                    .area_um2 = 100,
                                    .vt_mv_um = 13,
                                    .beta_percent_um = 2.2};
inline constexpr double kWire_f = 10e-15;    ///< of a node
inline constexpr double kTrimmedSd = 0.002;  ///< of ln I after programming: 0.2 %
inline constexpr double kSlope = 0.7;        ///< 1/n of a channel without a divider
inline constexpr double kElectron_c = 1.602176634e-19;

/// U_T = k T / q, in volt.
double thermal_voltage(double temperature_c);

/// The specific current and I_s at a temperature, in ampere: mobility falls as T^-1.5, the threshold by 1 mV/K.
///
///   I_spec ~ T^0.5,   I_s = I_spec exp(-V_T / (n U_T))
double specific_current(const Transistor& transistor, double temperature_c);
double preexponential_current(const Transistor& transistor, double temperature_c);

/// Standard deviation of ln I between devices, at 27 C in weak inversion.
///
///   sd^2 = (kappa_0 A_VT / U_T)^2 / (W L) + A_beta^2 / (W L)     as made; source  Pelgrom et al. 1989
///   sd   = 0.2 %                                                 trimmed
double deviation_sd(const Transistor& transistor, double width, bool trimmed);

}  // namespace mote::analog

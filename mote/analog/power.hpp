#pragma once
/// Power of components: what a mixed-mode or a digital filter is made of.

#include <string>

#include "mote/analog/converter.hpp"

namespace mote::analog {

/// The clock of analog circuits, in particles a second: MIXED says 10 to 100 kHz; this is their geometric mean.
inline constexpr double kCircuitRate = 31622.776601683793;

/// Digital logic at a process node.
///
///   P = alpha C_L V^2 f,   alpha C_L proportional to bits, stages and the node's length
///
/// source  MIXED sec. V and its [10], Chandrakasan & Brodersen 1995
struct Process {
  double node_um = 0.35, vdd_v = 3.3;
};

/// A pipelined CORDIC: one result a clock, three words of `bits` in each of `bits` stages.
///
///   alpha C_L = 3 bits^2 (node / 0.35 um) 117 fF
///
/// The capacitance of a bit is set so that 12 bits at 0.35 um, 3.3 V and 1 MHz take the 550 uW of MIXED, Table IV; the
/// scaling with bits, node, voltage and clock is the law's.
///
/// unit    watt
double cordic_power(const Process& process, int bits, double clock_hz);

/// A CORDIC in MOS current-mode logic, 8 bits at 1.0 V: 4330 uW, whatever its clock up to 125 MHz, since its currents
/// flow all the time.
///
/// source  MIXED, Table IV and its [13], Musicer & Rabaey 2000
double mcml_power();

/// A ripple-carry adder of 16 bits: 0.21 mW at 2 MHz, by its clock.
///
/// source  MIXED sec. V and its [16]
double adder_power(double clock_hz);

/// A digital multiply-accumulate of 16 bits: 16 rows of adders and one that accumulates. Ours: the paper leaves it
/// open.
double digital_mac_power(double clock_hz);

/// What the digital power of a multiply-accumulate is divided by in analog, at kHz.
///
/// source  MIXED sec. V and its [7], Chawla 2004
inline constexpr double kAnalogMacSaving = 10;

/// Power of the arctangent and of the Gaussian as printed, proportional to I_a.
///
///   0.7225 uW and 10.97 uW a nA, at 3 V
///
/// unit    in: A; out: W
/// source  MIXED, Table II: both ends of both rows
double printed_arctan_power(double ia_a);
double printed_gaussian_power(double ia_a);

/// A comparator that decides a chain's step: 100 nW, assumed.
inline constexpr double kComparatorPower = 1e-7;

/// Random words of 32 bits: two adders of 16 bits each, assumed.
double random_words_power(int words, double clock_hz);

/// A noise source: the noise of a diode and its amplifier, 1 uW, assumed.
inline constexpr double kNoiseSourcePower = 1e-6;

}  // namespace mote::analog

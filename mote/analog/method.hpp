#pragma once
/// Which parts of a filter are analog, and how good they are.

#include <cstdint>
#include <optional>
#include <string_view>

#include "mote/analog/behaviour.hpp"
#include "mote/analog/converter.hpp"

namespace mote::analog {

/// Where the line between analog and digital runs.
enum class Method {
  kWeights = 1,           ///< weights are analog, between DAC and ADC (MIXED, Method-1)
  kAllButResampling = 2,  ///< all is analog but the choice of ancestors (MIXED, Method-2)
  kAllButRandom = 3       ///< IMH in the log domain: neither a Gaussian nor a digital resampler
};

/// What is done about the arctangent's known error.
enum class Calibration {
  kNone,
  kTransfer,  ///< the measurement goes through the measured transfer, too: both sides of the residual are bent alike
  kInflate    ///< the Gaussian is made wider by it: sqrt(sigma^2 + rms^2)
};

/// Errors of the parts that are neither of the two circuits nor converters.
///
/// None is in the paper. A gain is that of a current mirror; mirrors of a few square micrometres in weak inversion
/// match to about one per cent (Pelgrom, Duinmaijer & Welbers 1989), trimmed floating gates better. Memory is a voltage
/// on a gate, so its error is relative to the current: kappa dV / U_T, 0.2 % for 0.07 mV. In the log domain a factor e
/// is U_T / kappa = 37 mV, so a comparator's noise of 0.4 mV is 0.01.
struct Cells {
  double divider_gain = 0.01;      ///< sd of the gain of y/x
  double product_gain = 0.005;     ///< sd of the gain of each product with a constant
  double memory_error = 0.002;     ///< sd of a stored value, relative, anew at every step
  double memory_leak = 1e-4;       ///< share of a stored value that is lost in a step
  double source_gain = 0.02;       ///< sd of the scale of each noise source
  double source_clip = 4;          ///< noise sources are bounded by this many standard deviations
  double multiplier_gain = 0.01;   ///< sd of the weight of a particle in the estimate's sum
  double squarer_gain = 0.02;      ///< sd of the gain of x^2/2 in the log domain
  double comparator_noise = 0.01;  ///< sd of log w as the chain compares it, in nat
};

/// A mixed-mode design. A function without a behaviour stays digital.
struct Design {
  Method method = Method::kWeights;
  std::optional<Behaviour> arctan, gaussian;
  ConverterSheet dac = tlc5615(), adc = ads7830();
  Cells cells;
  Calibration calibration = Calibration::kNone;
  std::uint64_t seed = 0;  ///< of the errors of converters and other parts
};

/// The circuit with its error, against the exact function, and its noise so many times as large: what a better or worse
/// one would be.
Behaviour scaled(const Behaviour& circuit, double error, double noise);

}  // namespace mote::analog

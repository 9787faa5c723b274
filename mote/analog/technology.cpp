#include "mote/analog/technology.hpp"

#include <cmath>

namespace mote::analog {
namespace {

constexpr double kRoom_c = 27, kZero_k = 273.15;
constexpr double kBoltzmann_over_electron = 8.617333262e-5;  // V/K
constexpr double kThresholdDrift = -1e-3;                    // V/K

double ratio_to_room(double temperature_c) { return (temperature_c + kZero_k) / (kRoom_c + kZero_k); }

}  // namespace

double thermal_voltage(double temperature_c) { return kBoltzmann_over_electron * (temperature_c + kZero_k); }

double specific_current(const Transistor& transistor, double temperature_c) {
  return transistor.specific_a * std::sqrt(ratio_to_room(temperature_c));
}

double preexponential_current(const Transistor& transistor, double temperature_c) {
  const double threshold =
      thermal_voltage(kRoom_c) / kSlope * std::log(transistor.specific_a / transistor.preexponential_a) +
      kThresholdDrift * (temperature_c - kRoom_c);
  return specific_current(transistor, temperature_c) * std::exp(-kSlope * threshold / thermal_voltage(temperature_c));
}

double deviation_sd(const Transistor& transistor, double width, bool trimmed) {
  if (trimmed) return kTrimmedSd;
  const double root = std::sqrt(transistor.area_um2 * width);
  return std::hypot(kSlope * 1e-3 * transistor.vt_mv_um / root / thermal_voltage(kRoom_c),
                    1e-2 * transistor.beta_percent_um / root);
}

}  // namespace mote::analog

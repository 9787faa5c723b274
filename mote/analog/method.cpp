#include "mote/analog/method.hpp"

namespace mote::analog {

Behaviour scaled(const Behaviour& circuit, double error, double noise) {
  constexpr std::size_t kPoints = 2001;
  std::vector<double> values(kPoints);
  std::vector<double> power(kPoints);
  std::vector<double> deviation(kPoints);
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double x = kRange * (2 * static_cast<double>(k) / (kPoints - 1) - 1);
    const double right = exact(circuit.facts().function, x);
    values[k] = right + error * (circuit(x) - right);
    power[k] = circuit.power_w(x);
    deviation[k] = noise * circuit.noise_sd(x);
  }
  return {circuit.facts(), Curve(values), Curve(power), Curve(deviation), circuit.devices()};
}

}  // namespace mote::analog

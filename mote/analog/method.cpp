#include "mote/analog/method.hpp"

namespace mote::analog {

Behaviour with_scaled_error(const Behaviour& circuit, double times) {
  constexpr std::size_t kPoints = 2001;
  std::vector<double> values(kPoints);
  std::vector<double> power(kPoints);
  std::vector<double> noise(kPoints);
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double x = kRange * (2 * static_cast<double>(k) / (kPoints - 1) - 1);
    const double right = exact(circuit.facts().function, x);
    values[k] = right + times * (circuit(x) - right);
    power[k] = circuit.power_w(x);
    noise[k] = circuit.noise_sd(x);
  }
  return {circuit.facts(), Curve(values), Curve(power), Curve(noise), circuit.devices()};
}

}  // namespace mote::analog

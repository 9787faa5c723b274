#pragma once
/// For tests: circuits without error, and such with a known one.

#include "mote/analog/method.hpp"

namespace mote::analog {

/// A behaviour that is a function plus `error(x)`, by a fine table; no noise, no power.
template <class Error>
Behaviour behaviour_with(Function function, const Error& error) {
  constexpr int kPoints = 4000;
  std::vector<double> values;
  for (int k = 0; k <= kPoints; ++k) {
    const double x = kRange * (2.0 * k / kPoints - 1);
    values.push_back(exact(function, x) + error(x));
  }
  Behaviour::Facts facts;
  facts.function = function;
  return {facts, Curve(values), Curve(), Curve(), {}};
}

inline Behaviour perfect(Function function) {
  return behaviour_with(function, [](double) { return 0.0; });
}

/// A method with perfect circuits, no converters and no errors of parts.
inline Design perfect_design(Method method) {
  Design design;
  design.method = method;
  design.arctan = perfect(Function::kArctan);
  if (method != Method::kAllButRandom) design.gaussian = perfect(Function::kGaussian);
  design.dac.bits = 0;
  design.adc.bits = 0;
  design.cells = {0, 0, 0, 0, 0, 100, 0, 0, 0};
  return design;
}

}  // namespace mote::analog

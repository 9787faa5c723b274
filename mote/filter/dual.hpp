#pragma once
/// Dual numbers: a model's lines run on them give its derivatives.

#include <cmath>

namespace mote {

/// A value and its slope along one direction: a + b e with e^2 = 0, so f(a + b e) = f(a) + f'(a) b e.
///
/// A number type that models accept: it has the arithmetic of model/model.hpp. Slopes of abs and floor are those of
/// their pieces; less() compares values.
///
/// source  Griewank & Walther 2008, ch. 3 (forward mode)
struct Dual {
  double value = 0, slope = 0;

  Dual() = default;
  explicit Dual(double constant) : value(constant) {}
  Dual(double at, double along) : value(at), slope(along) {}

  friend Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(Dual a, Dual b) { return {a.value * b.value, a.slope * b.value + a.value * b.slope}; }
  friend Dual operator/(Dual a, Dual b) {
    const double ratio = a.value / b.value;
    return {ratio, (a.slope - ratio * b.slope) / b.value};
  }
  friend Dual operator-(Dual a) { return {-a.value, -a.slope}; }
  friend bool less(Dual a, Dual b) { return a.value < b.value; }
  friend Dual select(bool condition, Dual a, Dual b) { return condition ? a : b; }
  friend Dual atan2(Dual y, Dual x) {
    const double squares = x.value * x.value + y.value * y.value;
    return {std::atan2(y.value, x.value), (x.value * y.slope - y.value * x.slope) / squares};
  }
  friend Dual sqrt(Dual a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope / (2 * root)};
  }
  friend Dual exp(Dual a) {
    const double power = std::exp(a.value);
    return {power, power * a.slope};
  }
  friend Dual log(Dual a) { return {std::log(a.value), a.slope / a.value}; }
  friend Dual sin(Dual a) { return {std::sin(a.value), std::cos(a.value) * a.slope}; }
  friend Dual cos(Dual a) { return {std::cos(a.value), -std::sin(a.value) * a.slope}; }
  friend Dual tan(Dual a) {
    const double tangent = std::tan(a.value);
    return {tangent, (1 + tangent * tangent) * a.slope};
  }
  friend Dual atan(Dual a) { return {std::atan(a.value), a.slope / (1 + a.value * a.value)}; }
  friend Dual abs(Dual a) { return a.value < 0 ? -a : a; }
  friend Dual floor(Dual a) { return Dual(std::floor(a.value)); }
};

}  // namespace mote

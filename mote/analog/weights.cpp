#include "mote/analog/weights.hpp"

#include <cmath>

#include "mote/analog/translinear.hpp"

namespace mote::analog {
namespace {

constexpr int kPoints = 801;
constexpr double kWide = 4;     // standard deviations to each side
constexpr double kSteep = 1.4;  // rad: the tangent of more is beyond what the circuit takes

/// Where the curve is highest: the vertex of the parabola through the three points about the largest.
double mode(const std::vector<double>& x, const std::vector<double>& y) {
  const auto top = static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
  if (top == 0 || top + 1 == y.size()) return x[top];
  const double before = y[top - 1];
  const double after = y[top + 1];
  const double bend = before - 2 * y[top] + after;
  return bend == 0 ? x[top] : x[top] + (x[top + 1] - x[top]) * (before - after) / (2 * bend);
}

}  // namespace

WeightCurve weight_curve(const Behaviour& arctan, const Behaviour& gaussian, double measured_rad, double sigma_rad) {
  WeightCurve curve{.sigma_rad = sigma_rad};
  const double least = std::max(measured_rad - kWide * sigma_rad, -kSteep);
  const double step = (std::min(measured_rad + kWide * sigma_rad, kSteep) - least) / (kPoints - 1);
  for (int k = 0; k < kPoints; ++k) {
    const double bearing = least + k * step;
    const double ratio = std::tan(bearing);
    curve.bearing_rad.push_back(bearing);
    curve.exact.push_back(exact(Function::kGaussian, (measured_rad - bearing) / sigma_rad));
    curve.approximation.push_back(
        approximation(Function::kGaussian, (measured_rad - approximation(Function::kArctan, ratio)) / sigma_rad));
    curve.analog.push_back(gaussian((measured_rad - arctan(ratio)) / sigma_rad));
  }
  curve.approximation_shift_rad = mode(curve.bearing_rad, curve.approximation) - measured_rad;
  curve.analog_shift_rad = mode(curve.bearing_rad, curve.analog) - measured_rad;
  return curve;
}

}  // namespace mote::analog

#include "mote/analog/behaviour.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mote::analog {
namespace {

constexpr std::size_t kSteps = 400;  // points of an error, and of a die's curve, less one

double at(std::size_t point, std::size_t steps) {
  return kRange * (2 * static_cast<double>(point) / static_cast<double>(steps) - 1);
}

/// Second derivatives of the natural cubic spline through equidistant points: a tridiagonal system, by elimination.
std::vector<double> curvatures(const std::vector<double>& y) {
  const std::size_t n = y.size();
  std::vector<double> m(n, 0.0);
  std::vector<double> factor(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double pivot = 4 + factor[k - 1];
    factor[k] = -1 / pivot;
    m[k] = (6 * (y[k - 1] - 2 * y[k] + y[k + 1]) - m[k - 1]) / pivot;
  }
  for (std::size_t k = n - 1; k-- > 1;) m[k] += factor[k] * m[k + 1];
  return m;
}

}  // namespace

double exact(Function function, double x) {
  return function == Function::kArctan ? std::atan(x) : std::exp(-x * x / 2);
}

std::string name_of(Function function) { return function == Function::kArctan ? "arctan" : "gaussian"; }

std::vector<double> deviations_of_die(Function function, const std::vector<double>& sds, std::uint64_t seed,
                                      std::uint32_t die) {
  auto block = Draws{.seed = seed, .step = die, .stream = static_cast<std::uint32_t>(function)}.block(kMismatch);
  std::vector<double> deviations(sds.size());
  for (std::size_t d = 0; d < sds.size(); ++d) deviations[d] = sds[d] * block.particle(d).normal();
  return deviations;
}

Curve::Curve(const std::vector<double>& values) {
  const std::vector<double> m = curvatures(values);
  cells_.clear();
  for (std::size_t k = 0; k + 1 < values.size(); ++k)
    cells_.push_back(
        {values[k], values[k + 1] - values[k] - (2 * m[k] + m[k + 1]) / 6, m[k] / 2, (m[k + 1] - m[k]) / 6});
  last_ = static_cast<double>(cells_.size());
  per_unit_ = last_ / (2 * kRange);
}

Behaviour::Behaviour(Facts facts, Curve transfer, Curve power, Curve noise, std::vector<Sensitivity> devices)
    : facts_(facts),
      transfer_(std::move(transfer)),
      power_(std::move(power)),
      noise_(std::move(noise)),
      devices_(std::move(devices)) {
  double squares = 0;
  facts_.worst = 0;
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double error = transfer_(at(k, kSteps)) - exact(facts_.function, at(k, kSteps));
    squares += error * error;
    facts_.worst = std::max(facts_.worst, std::abs(error));
    noisy_ = noisy_ || noise_sd(at(k, kSteps)) > 0;
  }
  facts_.rms = std::sqrt(squares / (kSteps + 1));
}

std::string Behaviour::name() const {
  return fmt::format("{}, {}, I_a {:g} nA", name_of(facts_.function),
                     facts_.level == Level::kIdeal ? "ideal" : "realistic", 1e9 * facts_.ia_a);
}

Behaviour Behaviour::on_die(std::uint64_t seed, std::uint32_t die) const {
  std::vector<double> sds;
  for (const Sensitivity& device : devices_) sds.push_back(device.sd);
  const std::vector<double> deviations = deviations_of_die(facts_.function, sds, seed, die);
  std::vector<double> values(kSteps + 1);
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double x = at(k, kSteps);
    values[k] = transfer_(x);
    for (std::size_t d = 0; d < devices_.size(); ++d) values[k] += deviations[d] * devices_[d].slope(x);
  }
  return {facts_, Curve(values), power_, noise_, devices_};
}

}  // namespace mote::analog

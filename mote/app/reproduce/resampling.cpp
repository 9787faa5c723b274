#include "mote/app/reproduce/resampling.hpp"

#include <chrono>
#include <cmath>

namespace mote::reproduce {
namespace {

void weigh(WeightedValues& set, double sharpness) {
  double sum = 0;
  for (std::size_t i = 0; i < set.values.size(); ++i)
    sum += set.weights[i] = std::exp(-0.5 * sharpness * std::pow(set.values[i] - 1, 2));
  for (double& w : set.weights) w /= sum;
}

double ess_share(const WeightedValues& set) {
  double squares = 0;
  for (const double w : set.weights) squares += w * w;
  return 1 / squares / static_cast<double>(set.weights.size());
}

/// Weighted mean of a function of the values.
template <class Function>
double expectation(const WeightedValues& set, Function&& function) {
  double sum = 0;
  for (std::size_t i = 0; i < set.values.size(); ++i) sum += set.weights[i] * function(set.values[i]);
  return sum;
}

}  // namespace

WeightedValues weighted_values(std::size_t particles, double ess, std::uint64_t seed) {
  WeightedValues set{{}, std::vector<double>(particles)};
  Draws{seed, 0}.for_each(Purpose::kPrior, 0, particles,
                          [&](std::size_t, auto& draw) { set.values.push_back(draw.normal()); });
  double low = -20;  // log of the sharpness: the effective sample size falls with it
  double high = 20;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    weigh(set, std::exp(middle));
    (ess_share(set) > ess ? low : high) = middle;
  }
  return set;
}

Resampled resampled(const Scheme& scheme, const WeightedValues& set, std::size_t draws, std::uint64_t seed) {
  using Clock = std::chrono::steady_clock;
  const auto n = static_cast<double>(set.values.size());
  const double mean = expectation(set, [](double x) { return x; });
  const double variance = expectation(set, [&](double x) { return (x - mean) * (x - mean); }) / n;
  std::vector<std::uint32_t> ancestors(set.values.size());
  Clock::duration spent{};
  double squares = 0;
  for (std::size_t l = 1; l <= draws; ++l) {
    const auto start = Clock::now();
    scheme.resample(set.weights, Draws{seed, static_cast<std::uint32_t>(l)}, ancestors);
    spent += Clock::now() - start;
    double sum = 0;
    for (const std::uint32_t a : ancestors) sum += set.values[a];
    squares += (sum / n - mean) * (sum / n - mean);
  }
  const auto count = static_cast<double>(draws);
  return {squares / count / variance, std::chrono::duration<double, std::nano>(spent).count() / (count * n)};
}

}  // namespace mote::reproduce

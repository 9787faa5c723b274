#pragma once
/// Observations for the models of the circuits' tests.

#include <cmath>
#include <random>
#include <vector>

#include "mote/hardware/filters/cosim/bench.hpp"
#include "mote/hardware/filters/cosim/models.hpp"

namespace mote::hardware::cosim {

inline Sight packed(const std::vector<std::int64_t>& values, const std::vector<unsigned>& widths) {
  Sight sight{0, values};
  unsigned at = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sight.word |= (static_cast<std::uint64_t>(values[i]) & ((std::uint64_t{1} << widths[i]) - 1)) << at;
    at += widths[i];
  }
  return sight;
}

/// A walk of the local level, with an observation far off now and then, or without.
inline std::vector<Sight> level_sights(std::size_t steps, std::uint64_t seed, bool far = true) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Sight> sights;
  double level = 1120;
  for (std::size_t k = 0; k < steps; ++k) {
    level += 38.3 * normal(random);
    const double y = far && k % 11 == 7 ? 4000 : level + 123 * normal(random);
    sights.push_back(packed({saturated(std::lround(32 * y), 18)}, {18}));
  }
  return sights;
}

/// Two growth models, with an observation far off now and then, or without.
inline std::vector<Sight> growth_sights(std::size_t steps, std::uint64_t seed, bool far = true) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Sight> sights;
  double x[2] = {0, 0};
  for (std::size_t k = 0; k < steps; ++k) {
    const double cosine = 8 * std::cos(1.2 * static_cast<double>(k));
    std::vector<std::int64_t> values;
    for (double& state : x) {
      state = state / 2 + 25 * state / (1 + state * state) + cosine + std::sqrt(10.0) * normal(random);
      const double y = far && k % 13 == 9 ? 500 : state * state / 20 + normal(random);
      values.push_back(saturated(std::lround(1024 * y), 20));
    }
    values.push_back(std::lround(1024 * cosine));
    sights.push_back(packed(values, {20, 20, 18}));
  }
  return sights;
}

}  // namespace mote::hardware::cosim

#pragma once
/// Golden twins of the models of the circuits' tests, which circuits are told apart by: other widths, other latencies.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mote/hardware/filters/arithmetic.hpp"

namespace mote::hardware::cosim {

/// The sum of a word's bytes about its mean: nearly Gaussian, standard deviation 147.8.
inline std::int64_t byte_sum(std::uint32_t word) {
  return static_cast<std::int64_t>((word & 255) + ((word >> 8) & 255) + ((word >> 16) & 255) + (word >> 24)) - 510;
}
inline std::int64_t saturated(std::int64_t value, unsigned bits) {
  const std::int64_t limit = std::int64_t{1} << (bits - 1);
  return std::clamp(value, -limit, limit - 1);
}

/// cosim/local_level_propose.sv and local_level_weigh.sv; observed: y with 5 fraction bits.
inline Arithmetic local_level() {
  Arithmetic model;
  model.formats.draw_words = 2;
  model.propose = [](unsigned t, Observed, const Particles& parents, const WordColumns& words, Particles& states) {
    for (std::size_t j = 0; j < states[0].size(); ++j) {
      const std::int64_t base = t == 1 ? 35840 + ((byte_sum(words[0][j]) * 17527) >> 8) : parents[0][j];
      states[0][j] = saturated(base + ((byte_sum(words[1][j]) * 2125) >> 8), 18);
    }
  };
  model.weigh = [](unsigned, Observed observed, const Particles& states, std::span<std::int64_t> log_weights) {
    for (std::size_t j = 0; j < log_weights.size(); ++j) {
      const std::int64_t error = observed[0] - states[0][j];
      log_weights[j] = -((((error * error) >> 10) * 3206) >> 16);
    }
  };
  return model;
}

/// The drift table that growth_propose.sv reads, growth.hex.
inline const std::array<std::int64_t, 1024>& growth_table() {
  static const auto table = [] {
    std::array<std::int64_t, 1024> filled{};
    for (int k = 0; k < 1024; ++k) {
      const double x = ((k < 512 ? k : k - 1024) + 0.5) / 4;
      filled[static_cast<std::size_t>(k)] = std::lround(1024 * (x / 2 + 25 * x / (1 + x * x)));
    }
    return filled;
  }();
  return table;
}

/// cosim/growth_propose.sv and growth_weigh.sv; observed: y1, y2 and the cosine, with 10 fraction bits.
inline Arithmetic growth() {
  Arithmetic model;
  model.formats.dims = 2;
  model.formats.draw_words = 2;
  model.formats.propose_latency = 6;
  model.formats.weigh_latency = 5;
  model.propose = [](unsigned t, Observed observed, const Particles& parents, const WordColumns& words,
                     Particles& states) {
    for (std::size_t d = 0; d < 2; ++d)
      for (std::size_t j = 0; j < states[d].size(); ++j) {
        const auto at = static_cast<std::size_t>((parents[d][j] >> 8) & 1023);
        const std::int64_t drift = t == 1 ? 0 : growth_table()[at];
        states[d][j] = saturated(drift + observed[2] + ((byte_sum(words[d][j]) * 5608) >> 8), 18);
      }
  };
  model.weigh = [](unsigned, Observed observed, const Particles& states, std::span<std::int64_t> log_weights) {
    for (std::size_t j = 0; j < log_weights.size(); ++j) {
      std::int64_t squares = 0;
      for (std::size_t d = 0; d < 2; ++d) {
        const std::int64_t x = states[d][j];
        const std::int64_t error =
            std::clamp<std::int64_t>(observed[d] - ((((x * x) >> 10) * 3277) >> 16), -524287, 524287);
        squares += (error * error) >> 10;
      }
      log_weights[j] = -std::min<std::int64_t>((squares * 47274) >> 16, 8388607);
    }
  };
  return model;
}

/// The same with a particle every `interval` cycles.
inline Arithmetic growth_every(unsigned interval) {
  Arithmetic model = growth();
  model.formats.interval = interval;
  return model;
}

/// cosim/sisr_ranked.sv; observed: how many particles have a weight.
inline Arithmetic ranked() {
  Arithmetic model;
  model.formats.dims = 2;
  model.formats.value_bits = 12;
  model.formats.propose_latency = model.formats.weigh_latency = 1;
  model.propose = [](unsigned t, Observed, const Particles& parents, const WordColumns&, Particles& states) {
    for (std::size_t j = 0; j < states[0].size(); ++j) {
      states[0][j] = static_cast<std::int64_t>(j);
      states[1][j] = t == 1 ? 0 : parents[0][j];
    }
  };
  model.weigh = [](unsigned, Observed observed, const Particles& states, std::span<std::int64_t> log_weights) {
    for (std::size_t j = 0; j < log_weights.size(); ++j) log_weights[j] = states[0][j] < observed[0] ? 0 : -1048576;
  };
  return model;
}

}  // namespace mote::hardware::cosim

#pragma once
/// A random walk seen in noise, drawn as two pipelines by hand: the model of the machines' tests.

#include <cmath>
#include <random>

#include "mote/hardware/machine/model_circuit.hpp"
#include "mote/hardware/random.hpp"
#include "mote/hardware/sketch.hpp"

namespace mote::hardware {

inline constexpr Format kLevel{true, 12, 5};
inline constexpr Format kLogWeight{true, 13, 10};

/// x_0 = 1120 + 316.2 z_0,   x' = x + 38.3 z_1.
inline Compound level_propose() {
  Sketch s("local_level_propose", Multiplier::kDsp);
  const Signal first = s.input("first_i", {false, 1, 0});
  const Signal parent = s.input("state_i", kLevel);
  const Signal prior_word = s.input("word0_i", kSignedBits);
  const Signal move_word = s.input("word1_i", kSignedBits);
  static const Piecewise kNormal = normal_unit(14);
  const auto normal = [&](const Signal& word) { return s.op(kNormal, {true, 3, 14}, word); };
  const Signal drawn =
      s.sum(s.constant(kLevel, 1120), s.scaled(normal(prior_word), std::sqrt(1e5), 16, kLevel), kLevel);
  const Signal before = s.select(first, drawn, parent);
  s.output("state_o", s.sum(before, s.scaled(normal(move_word), std::sqrt(1469.1), 16, kLevel), kLevel));
  return s.done();
}

/// lw = -(y - x)^2 / (2 15099) log2(e).
inline Compound level_weigh() {
  Sketch s("local_level_weigh", Multiplier::kDsp);
  const Signal y = s.input("y_i", kLevel);
  const Signal x = s.input("state_i", kLevel);
  const Signal error = s.difference(y, x, {true, 13, 5});
  const Signal square = s.product(error, error, {true, 26, 0});
  s.output("log_o", s.scaled(square, -std::log2(std::exp(1.0)) / (2 * 15099), 16, kLogWeight));
  return s.done();
}

/// A compound's twin on columns.
inline void run_twin(const Compound& compound, const std::vector<std::vector<Word>>& in, std::span<Word> out) {
  const std::vector<std::span<const Word>> columns(in.begin(), in.end());
  compound.compute(columns, std::vector<std::span<Word>>{out});
}

inline ModelCircuit local_level_circuit() {
  const Compound propose = level_propose();
  const Compound weigh = level_weigh();
  ModelCircuit model{
      "local_level", propose.circuit(), weigh.circuit(), {}, {}, {{"level", kLevel}}, {{"y", kLevel}}, {}};
  model.propose_connections = {{"clk_i", "clk_i"},          {"first_i", "t == 16'd1"},    {"state_i", "parent"},
                               {"word0_i", "words[0+:32]"}, {"word1_i", "words[32+:32]"}, {"state_o", "proposed"}};
  model.weigh_connections = {
      {"clk_i", "clk_i"}, {"y_i", "weigh_obs"}, {"state_i", "to_weigh"}, {"log_o", "log_weight"}};
  Formats& f = model.arithmetic.formats;
  f.draw_words = 2;
  f.propose_latency = static_cast<unsigned>(model.propose.latency);
  f.weigh_latency = static_cast<unsigned>(model.weigh.latency);
  model.arithmetic.propose = [propose](unsigned t, Observed, const Particles& parents, const WordColumns& words,
                                       Particles& states) {
    const std::size_t n = states[0].size();
    std::vector<std::vector<Word>> in{std::vector<Word>(n, t == 1), parents[0]};
    for (const auto& column : words) {
      in.emplace_back(n);
      std::transform(column.begin(), column.end(), in.back().begin(), signed_bits);
    }
    run_twin(propose, in, states[0]);
  };
  model.arithmetic.weigh = [weigh](unsigned, Observed observed, const Particles& states, std::span<Word> log_weights) {
    run_twin(weigh, {std::vector<Word>(log_weights.size(), observed[0]), states[0]}, log_weights);
  };
  return model;
}

/// A walk as the model draws it.
inline std::vector<std::vector<std::int64_t>> level_observations(std::size_t steps, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<std::vector<std::int64_t>> observed;
  double level = 1120 + std::sqrt(1e5) * normal(random);
  for (std::size_t k = 0; k < steps; ++k) {
    level += std::sqrt(1469.1) * normal(random);
    observed.push_back({kLevel.nearest(level + std::sqrt(15099.0) * normal(random))});
  }
  return observed;
}

}  // namespace mote::hardware

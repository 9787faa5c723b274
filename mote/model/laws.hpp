#pragma once
/// The laws every model obeys, as tests: `MOTE_MODEL_LAWS(Ungm, Ungm<1>{})` ends a model's test file.
///
/// Two number types stand in for those of later engines: a recording Node (a graph) and a Pack (a vector of four).

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "mote/model/law_numbers.hpp"
#include "mote/model/model.hpp"

namespace mote::laws {

/// A state the model reaches by itself after `steps` steps, and a row that it could observe there.
template <class M>
struct Scene {
  StateOf<M, double> before, x;
  Row<double> y;
  Step t;
};

template <class M>
Scene<M> scene(const M& model, Step t, Draw<double>& draw) {
  StateOf<M, double> before = model.template initial<double>(draw);
  for (Step s = 1; s < t; ++s) before = model.template next<double>(s, before, draw);
  StateOf<M, double> x = model.template next<double>(t, before, draw);
  Row<double> y = model.template observe<double>(t, x, blank_row(model), draw);
  return {before, x, y, t};
}

/// All that the model's proposals compute at a scene: draws and log densities.
template <class S, class M, class D>
void add_proposals(const M& model, Step t, const StateOf<M, S>& before, const StateOf<M, S>& x, const Row<S>& y,
                   D& draw, std::vector<S>& all) {
  const auto add = [&]<class G>(const G*) {
    if constexpr (!std::is_same_v<G, Prior>) {
      const G proposal = make_proposal<G>(model);
      const std::array<Row<S>, 1> rows{y};
      for (const S& v : proposal.template propose<S>(model, t, before, rows, draw)) all.push_back(v);
      all.push_back(proposal.template log_density<S>(model, t, x, before, rows));
    }
  };
  if constexpr (requires { typename M::Proposals; }) {
    [&]<class... G>(const std::tuple<G...>*) {
      (add(static_cast<const G*>(nullptr)), ...);
    }(static_cast<const typename M::Proposals*>(nullptr));
  }
}

/// All that a model computes at a scene – next state, log likelihood, log transition, proposals – in the number type S,
/// as one list.
template <class S, class M, class D>
std::vector<S> everything(const M& model, Step t, const StateOf<M, S>& before, const StateOf<M, S>& x, const Row<S>& y,
                          D& draw) {
  std::vector<S> all;
  for (const S& v : model.template initial<S>(draw)) all.push_back(v);
  for (const S& v : model.template next<S>(t, before, draw)) all.push_back(v);
  all.push_back(model.template log_likelihood<S>(t, x, y));
  if constexpr (HasTransition<M>) {
    all.push_back(model.template log_transition<S>(t, x, before));
    if (model.density() != Density::kNone) add_proposals<S>(model, t, before, x, y, draw, all);
  }
  return all;
}

template <class S, class M>
StateOf<M, S> lifted(const M& model, const std::vector<S>& values) {
  auto state = blank_state<S>(model);
  std::copy(values.begin(), values.end(), state.begin());
  return state;
}

template <class M>
void expect_recording_equals_direct(const M& model) {
  auto block = Draws{11, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  for (Step t = 1; t <= 20; ++t) {
    const auto at = scene(model, t, source);
    auto numbers = listed(source);
    const auto direct = everything<double>(model, t, at.before, at.x, at.y, numbers);

    Tape tape;
    Tape::current() = &tape;
    std::vector<double> inputs;
    const auto input = [&](double value) {
      inputs.push_back(value);
      Node node;
      node.id = tape.input();
      return node;
    };
    const auto inputs_of = [&](const auto& list) {
      std::vector<Node> nodes;
      for (const double v : list) nodes.push_back(input(v));
      return nodes;
    };
    const auto before = lifted<Node>(model, inputs_of(at.before));
    const auto x = lifted<Node>(model, inputs_of(at.x));
    const Row<Node> y{inputs_of(at.y.values), at.y.present};
    ListedDraw<Node> draw{inputs_of(numbers.normals), inputs_of(numbers.uniforms)};
    const auto recorded = everything<Node>(model, t, before, x, y, draw);
    const auto values = tape.evaluate(inputs);
    ASSERT_EQ(recorded.size(), direct.size());
    for (std::size_t i = 0; i < direct.size(); ++i)
      EXPECT_EQ(values[static_cast<std::size_t>(recorded[i].id)], direct[i]) << "output " << i << " at t = " << t;
  }
}

template <class M>
void expect_vector_equals_lanes(const M& model) {
  auto block = Draws{12, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  const Step t = 5;
  std::vector<Scene<M>> scenes;
  std::vector<ListedDraw<double>> draws;
  for (std::size_t lane = 0; lane < Pack::kLanes; ++lane) {
    scenes.push_back(scene(model, t, source));
    draws.push_back(listed(source));
  }
  const auto packed = [&](auto&& part) {
    std::vector<Pack> packs(part(0).size());
    for (std::size_t lane = 0; lane < Pack::kLanes; ++lane)
      for (std::size_t i = 0; i < packs.size(); ++i) packs[i].v[lane] = part(lane)[i];
    return packs;
  };
  const auto before = lifted<Pack>(model, packed([&](std::size_t l) { return scenes[l].before; }));
  const auto x = lifted<Pack>(model, packed([&](std::size_t l) { return scenes[l].x; }));
  const Row<Pack> y{packed([&](std::size_t l) { return scenes[l].y.values; }), scenes[0].y.present};
  ListedDraw<Pack> draw{packed([&](std::size_t l) { return draws[l].normals; }),
                        packed([&](std::size_t l) { return draws[l].uniforms; })};
  const auto all = everything<Pack>(model, t, before, x, y, draw);
  for (std::size_t lane = 0; lane < Pack::kLanes; ++lane) {
    const auto direct = everything<double>(model, t, scenes[lane].before, scenes[lane].x, scenes[lane].y, draws[lane]);
    for (std::size_t i = 0; i < direct.size(); ++i) EXPECT_EQ(all[i].v[lane], direct[i]);
  }
}

/// Float gives the double result to float's resolution; a mixture's log density may be -infinity where float's exp
/// underflows.
template <class M>
void expect_float_follows_double(const M& model) {
  auto block = Draws{13, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  const auto at = scene(model, 3, source);
  auto numbers = listed(source);
  const auto direct = everything<double>(model, 3, at.before, at.x, at.y, numbers);
  const auto shortened = [](const auto& list) { return std::vector<float>(list.begin(), list.end()); };
  ListedDraw<float> draw{shortened(numbers.normals), shortened(numbers.uniforms)};
  const auto single = everything<float>(model, 3, lifted<float>(model, shortened(at.before)),
                                        lifted<float>(model, shortened(at.x)), at.y.template as<float>(), draw);
  constexpr double kUnderflow = -87;  // the log of float's least normal number
  for (std::size_t i = 0; i < direct.size(); ++i) {
    if (direct[i] < kUnderflow && std::isinf(single[i])) continue;
    EXPECT_NEAR(static_cast<double>(single[i]), direct[i], 2e-3 * (1 + std::abs(direct[i]))) << "output " << i;
  }
}

/// The same number of draws for any state: what addressing and vectors rest on.
template <class M>
void expect_constant_draws(const M& model) {
  auto block = Draws{14, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  std::vector<std::array<std::size_t, 2>> taken;
  for (Step t = 1; t <= 50; ++t) {
    const auto at = scene(model, t, source);
    auto draw = listed(source);
    model.template next<double>(t, at.before, draw);
    taken.push_back({draw.taken_normals, draw.taken_uniforms});
  }
  for (const auto& count : taken) EXPECT_EQ(count, taken.front());
}

/// z score of the claim that the mean of f(i), i < n, is 1.
template <class F>
double z_of_mean_one(int n, F f) {
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < n; ++i) {
    const double v = f();
    sum += v;
    squares += v * v;
  }
  const double mean = sum / n;
  return (mean - 1) / std::sqrt((squares / n - mean * mean) / n + 1e-300);
}

/// The ratio's mean is 1, and the twin, the ratio raised to the power 0.7, must not have it.
template <class LogRatio>
void expect_density_ratio(LogRatio log_ratio) {
  const auto z = [&](double power) { return z_of_mean_one(40000, [&] { return std::exp(power * log_ratio()); }); };
  EXPECT_LT(std::abs(z(1.0)), 4.89);
  EXPECT_GT(std::abs(z(0.7)), 4.89) << "the twin must fail";
}

/// A state near `from` whose image under the model lies about `shift` standard deviations of one step away.
template <class M, class Image>
StateOf<M, double> nearby(const StateOf<M, double>& from, const std::vector<double>& spread, double shift,
                          Image image) {
  const auto reference = image(from);
  for (double delta = shift;; delta /= 2) {
    auto other = from;
    for (std::size_t d = 0; d < other.size(); ++d) other[d] += delta * spread[d];
    const auto moved = image(other);
    bool near = true;
    for (std::size_t d = 0; d < reference.size(); ++d)
      near = near && std::abs(moved[d] - reference[d]) <= shift * spread[d] + 1e-12;
    if (near) return other;
  }
}

// claim    log_transition is the density of next():  E[ p(x | b') / p(x | b) ] = 1 for x drawn from b
// referee  the identity itself, b' about 0.7 standard deviations away
// design   40 000 draws, one fixed seed
// risk     1e-6 (|z| < 4.89); the twin, the density raised to the power 0.7, must fail
template <HasTransition M>
void expect_transition_density(const M& model) {
  auto block = Draws{15, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  const Step t = 3;
  const auto at = scene(model, t, draw);
  std::vector<double> spread;
  {
    std::vector<StateOf<M, double>> samples;
    for (int i = 0; i < 500; ++i) samples.push_back(model.template next<double>(t, at.before, draw));
    for (std::size_t d = 0; d < at.before.size(); ++d) {
      double mean = 0;
      double squares = 0;
      for (const auto& s : samples) mean += s[d] / 500;
      for (const auto& s : samples) squares += (s[d] - mean) * (s[d] - mean) / 500;
      spread.push_back(std::sqrt(squares));
    }
  }
  const auto other = nearby<M>(at.before, spread, 0.7, [&](const auto& b) {
    ListedDraw<double> still{std::vector<double>(kListed, 0.0), std::vector<double>(kListed, 0.5)};
    return model.template next<double>(t, b, still);
  });
  expect_density_ratio([&] {
    const auto x = model.template next<double>(t, at.before, draw);
    return model.template log_transition<double>(t, x, other) - model.template log_transition<double>(t, x, at.before);
  });
}

// claim    log_likelihood is the density of observe():  E[ p(y | x') / p(y | x) ] = 1 for y drawn from x
// design, risk and twin as for the transition
template <Observable M>
void expect_observation_density(const M& model) {
  auto block = Draws{16, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  const auto at = scene(model, 4, draw);
  const Row<double> inputs = blank_row(model);
  const auto log_ratio = [&](const auto& other, const auto& y) {
    return model.template log_likelihood<double>(4, other, y) - model.template log_likelihood<double>(4, at.x, y);
  };
  // shrink the displacement until the log ratio has a standard deviation of about 0.7 or less
  auto other = at.x;
  for (double delta = 1;; delta /= 2) {
    for (std::size_t d = 0; d < other.size(); ++d)
      other[d] = at.x[d] + (d % 4 < 2 ? delta : -delta) * (0.01 + std::abs(at.x[d]));
    double squares = 0;
    for (int i = 0; i < 200; ++i)
      squares += std::pow(log_ratio(other, model.template observe<double>(4, at.x, inputs, draw)), 2) / 200;
    if (squares < 0.6) break;
  }
  expect_density_ratio([&] { return log_ratio(other, model.template observe<double>(4, at.x, inputs, draw)); });
}

/// An empty field contributes nothing; a row of empty fields has likelihood one.
template <class M>
void expect_empty_fields_are_silent(const M& model) {
  auto block = Draws{17, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  const auto at = scene(model, 2, draw);
  EXPECT_EQ(model.template log_likelihood<double>(2, at.x, blank_row(model)), 0.0);
  EXPECT_EQ(model.columns().size(), at.y.values.size());
  EXPECT_EQ(model.states().size(), at.x.size());
}

}  // namespace mote::laws

/// The laws of one model; `...` is an expression that makes it.
#define MOTE_MODEL_LAWS(Name, ...)                                                                                \
  static_assert(::mote::Observable<decltype(__VA_ARGS__)>);                                                       \
  TEST(Name##Laws, RecordingEqualsDirectBitForBit) { ::mote::laws::expect_recording_equals_direct(__VA_ARGS__); } \
  TEST(Name##Laws, VectorEqualsLanes) { ::mote::laws::expect_vector_equals_lanes(__VA_ARGS__); }                  \
  TEST(Name##Laws, FloatFollowsDouble) { ::mote::laws::expect_float_follows_double(__VA_ARGS__); }                \
  TEST(Name##Laws, DrawsAreConstantInNumber) { ::mote::laws::expect_constant_draws(__VA_ARGS__); }                \
  TEST(Name##Laws, TransitionIsTheDensityOfNext) { ::mote::laws::expect_transition_density(__VA_ARGS__); }        \
  TEST(Name##Laws, LikelihoodIsTheDensityOfObserve) { ::mote::laws::expect_observation_density(__VA_ARGS__); }    \
  TEST(Name##Laws, EmptyFieldsAreSilent) { ::mote::laws::expect_empty_fields_are_silent(__VA_ARGS__); }

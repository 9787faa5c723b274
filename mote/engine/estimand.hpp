#pragma once
/// Functions of interest: what is estimated besides each state's mean and standard deviation.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mote/filter/estimate.hpp"
#include "mote/model/model.hpp"

namespace mote {

/// Something that can be estimated: a state, or a function that the model names.
struct ValueSource {
  Quantity quantity;
  std::function<void(const WeightedSet&, std::span<double>)> fill;  ///< values of all particles
};

/// An estimate to take at each step.
struct Estimand {
  enum class Kind { kMean, kSd, kQuantile, kAbove, kBelow };
  std::string label;  ///< the text it was asked by, and its column's name
  Kind kind;
  double argument;  ///< level of a quantile, threshold of a probability
  std::size_t source;
};

/// States and named functions of a model, in that order.
template <Model M>
std::vector<ValueSource> value_sources(const M& model) {
  std::vector<ValueSource> all;
  const std::vector<Quantity> states = model.states();
  for (std::size_t d = 0; d < states.size(); ++d)
    all.push_back({states[d], [d](const WeightedSet& set, std::span<double> out) {
                     set.visit(
                         [&](const auto& x) { std::copy(x.component(d).begin(), x.component(d).end(), out.begin()); });
                   }});
  if constexpr (requires { model.functions(); }) {
    for (const auto& function : model.functions())
      all.push_back({function.quantity, [function, state = blank_state<double>(model)](const WeightedSet& set,
                                                                                       std::span<double> out) mutable {
                       set.visit([&](const auto& x) {
                         for (std::size_t i = 0; i < out.size(); ++i) {
                           x.read(i, state);
                           out[i] = function.value(state);
                         }
                       });
                     }});
  }
  return all;
}

/// Reads `mean(f)`, `sd(f)`, `median(f)`, `q0.9(f)`, `P(f>1.5)`, `P(f<0)` or `f` (its mean), f a state or a function of
/// the model.
///
/// error   Refusal (kWrongUse) with the names there are
Estimand parse_estimand(const std::string& text, const std::vector<ValueSource>& sources, const std::string& where);

/// The value of an estimand on a weighted set; `scratch` is resized to the set.
double evaluate(const Estimand& estimand, const ValueSource& source, const WeightedSet& set,
                std::vector<double>& scratch);

}  // namespace mote

#pragma once
/// Weigh: likelihoods onto log weights, and what the weights say.

#include <span>
#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/filter/filter.hpp"
#include "mote/filter/propose.hpp"

namespace mote {

/// The rows of a step in the number type R.
template <class R>
std::vector<Row<R>> rows_as(Rows<double> rows) {
  std::vector<Row<R>> all;
  for (const auto& row : rows) all.push_back(row.template as<R>());
  return all;
}

/// sum over the rows of a step of log p(y | x); docs/filters.md (F26).
template <class R, Model M>
double log_likelihood(const M& model, Step t, const StateOf<M, R>& x, Rows<R> y) {
  double sum = 0;
  for (const Row<R>& row : y) sum += static_cast<double>(model.template log_likelihood<R>(t, x, row));
  return usable(sum);
}

/// A model that weighs particles [first, N) in one call, side by side if it likes: an image likelihood, whose particles
/// cost microseconds each. It adds the same numbers as log_likelihood() one by one.
template <class M, class R>
concept WeighsAll = Model<M> &&
    requires(const M& m, Step t, Rows<R> y, const Particles<R>& x, std::size_t first, std::span<double> log_weights) {
  m.weigh_all(t, y, x, first, log_weights);
};

/// Adds log p(y | x_i) to the log weights of particles [first, last).
template <Model M, class R>
void weigh(const M& model, Step t, Rows<R> y, const Particles<R>& x, std::span<double> log_weights, std::size_t first,
           std::size_t last) {
  if constexpr (WeighsAll<M, R>)
    if (last == x.size()) return model.weigh_all(t, y, x, first, log_weights);
  auto state = blank_state<R>(model);
  for (std::size_t i = first; i < last; ++i) {
    x.read(i, state);
    log_weights[i] += log_likelihood<R>(model, t, state, y);
  }
}

/// Adds log p(y | x_i) to all log weights.
template <Model M, class R>
void weigh(const M& model, Step t, Rows<R> y, const Particles<R>& x, std::span<double> log_weights) {
  weigh<M, R>(model, t, y, x, log_weights, 0, x.size());
}

/// What a weight vector says of its step.
struct Judgement {
  double log_sum;  ///< log sum_i exp(log_weights[i]) before normalising
  double total;    ///< sum of the linear weights
  double ess;
  bool collapsed;  ///< all weights zero
};

/// Writes linear weights with maximum 1; on collapse nothing changes.
///
/// cost    O(N), one exponential a particle
inline Judgement judge(std::span<const double> log_weights, std::span<double> weights) {
  double largest = -kInfinity;
  for (const double l : log_weights) largest = largest < l ? l : largest;
  if (!std::isfinite(largest)) return {-kInfinity, 0, 0, true};
  const double total = exponentiate(log_weights, largest, weights);
  return {largest + std::log(total), total, effective_sample_size(weights), false};
}

}  // namespace mote

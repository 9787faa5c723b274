#pragma once
/// What any model must offer. A model is written once, generic in its number type S, and every engine runs those lines.
///
///     x_0 ~ initial;   x_t ~ next(t, x_{t-1});   p(y_t | x_t) = exp(log_likelihood(t, x_t, y_t))
///
/// Laws (model/laws.hpp checks them, one line per model):
///   - recorded, vector and plain numbers give the same bits: no branch on a value of type S, only select();
///   - every call of next() takes the same number of draws, whatever the state;
///   - log_transition is the density of next(), log_likelihood that of observe();
///   - an empty field of a row contributes nothing.

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"

namespace mote {

/// A state, or a function of the state, by name.
struct Quantity {
  std::string name;
  std::string unit;
  bool angle = false;  ///< estimated by circular mean and deviation, scored by the wrapped difference
};

/// A column of the data that a model reads: an observation, or an input with a default.
struct Column {
  std::string name;
  std::string unit;
  bool input = false;
  double fallback = 0;     ///< the value of an input whose column is missing
  std::string state = {};  ///< the state that an observation measures directly, if any: they are plotted together
  bool angle = false;      ///< an observation known up to whole turns
};

/// One row of data: the model's observation columns in order, then its inputs. An observation may be missing.
template <class S>
struct Row {
  std::vector<S> values;
  std::vector<bool> present;

  const S& operator[](std::size_t j) const { return values[j]; }
  bool seen(std::size_t j) const { return present[j]; }

  /// A row of the given values, all present.
  static Row of(std::vector<S> all) {
    const std::size_t n = all.size();
    return {std::move(all), std::vector<bool>(n, true)};
  }

  /// The same row in another number type.
  template <class T>
  Row<T> as() const {
    Row<T> row{{}, present};
    for (const S& v : values) row.values.push_back(static_cast<T>(v));
    return row;
  }
};

/// Rows of one step: several measurements of the same state; their likelihoods multiply.
template <class S>
using Rows = std::span<const Row<S>>;

/// The state of a model whose size is known at run time only.
template <class S>
using SmallVector = boost::container::small_vector<S, 8, std::allocator<S>>;  // it aligns vectors of numbers

/// In which space log_transition is a density.
enum class Density {
  kNone,   ///< there is none
  kNoise,  ///< density of the noise that leads from one state to the other: ratios p/g are right, sums over parents are
           ///< not
  kState,  ///< density in the state itself
};

/// A function of interest named by a model.
template <class M>
struct Function {
  Quantity quantity;
  std::function<double(const typename M::template State<double>&)> value;
};

/// The contract of a model.
template <class M>
concept Model = requires(const M& m, Step t, const typename M::template State<double>& x, const Row<double>& y,
                         Draw<double>& draw) {
  { m.states() } -> std::convertible_to<std::vector<Quantity>>;
  { m.columns() } -> std::convertible_to<std::vector<Column>>;
  { m.template initial<double>(draw) } -> std::same_as<typename M::template State<double>>;
  { m.template next<double>(t, x, draw) } -> std::same_as<typename M::template State<double>>;
  { m.template log_likelihood<double>(t, x, y) } -> std::same_as<double>;
};

/// A model that can also draw an observation: what `mote simulate` needs. `inputs` holds the row's inputs.
template <class M>
concept Observable = Model<M> && requires(const M& m, Step t, const typename M::template State<double>& x,
                                          const Row<double>& inputs, Draw<double>& draw) {
  { m.template observe<double>(t, x, inputs, draw) } -> std::same_as<Row<double>>;
};

/// A model with a transition density, in the state or in the noise; density() says which.
template <class M>
concept HasTransition = Model<M> && requires(const M& m, Step t, const typename M::template State<double>& x) {
  { m.density() } -> std::same_as<Density>;
  { m.template log_transition<double>(t, x, x) } -> std::same_as<double>;
};

/// A proposal g(x | x_{t-1}, y_t) of a model, with its density in the space of the model's transition density.
template <class G, class M>
concept ProposalOf = requires(const G& g, const M& m, Step t, const typename M::template State<double>& x,
                              Rows<double> y, Draw<double>& draw) {
  { g.template propose<double>(m, t, x, y, draw) } -> std::same_as<typename M::template State<double>>;
  { g.template log_density<double>(m, t, x, x, y) } -> std::same_as<double>;
};

/// The proposal g = p: particles move by the model itself and the weight is the likelihood.
struct Prior {
  static constexpr std::string_view kName = "prior";
  static constexpr std::string_view kMeaning = "the state transition itself; the weight is the likelihood";

  template <class S, class M, class D>
  auto propose(const M& model, Step t, const typename M::template State<S>& before, Rows<S>, D& draw) const {
    return model.template next<S>(t, before, draw);
  }
};

/// The proposal G for a model: built from the model if it prepares anything, else as it is.
template <class G, class M>
G make_proposal(const M& model) {
  if constexpr (std::is_constructible_v<G, const M&>) {
    return G(model);
  } else {
    return G{};
  }
}

template <class M, class S>
using StateOf = typename M::template State<S>;

/// An empty row for `model`: observations absent, inputs at their defaults.
template <Model M>
Row<double> blank_row(const M& model) {
  Row<double> row;
  for (const Column& column : model.columns()) {
    row.values.push_back(column.input ? column.fallback : kNaN);
    row.present.push_back(column.input);
  }
  return row;
}

/// An uninitialised state of the model's size.
template <class S, class M>
StateOf<M, S> blank_state(const M& model) {
  StateOf<M, S> state{};
  if constexpr (requires { state.resize(1); }) state.resize(model.states().size());
  return state;
}

}  // namespace mote

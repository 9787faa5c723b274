#pragma once
/// A model given as text: states, priors, right-hand sides and laws of observations as expressions.

#include <memory>
#include <optional>

#include "mote/base/refusal.hpp"
#include "mote/graph/drawn.hpp"
#include "mote/graph/interpreter.hpp"
#include "mote/graph/text/text_file.hpp"

namespace mote::graph {

/// What a text model computes.
struct TextParts {
  std::vector<Quantity> states;
  std::vector<Column> columns;
  std::size_t observed = 0;              ///< columns that are observations
  std::vector<bool> prior_draws, draws;  ///< by number: whether it is normal
  Program initial, next;
  Program observe;                              ///< from kState, kColumn and one normal number an observation
  std::vector<Program> laws;                    ///< terms of the log likelihood
  std::vector<std::vector<std::size_t>> needs;  ///< by law: the observations that it reads
  Program whole;                                ///< the sum of the laws
  std::optional<Program> transition;            ///< log density, from kState and kBefore
  std::string without_law;                      ///< an observation that cannot be drawn, if any

  /// The programs whose sum is the log likelihood of a row.
  SmallVector<const Program*> seen(const std::vector<bool>& present) const;
};

/// A model that a file describes; every number type and engine runs the same programs.
///
///   x_0 = states,   x_t = next(x_{t-1}, t, noise),   p(y_t | x_t) = product of the laws of what was seen
///
/// A product of constants, or of t and constants, is computed once; division by a constant is multiplication by its
/// inverse (Identities::kRounding). The transition density is known where each state's right-hand side is
/// f(x_{t-1}, t) + sd z with a normal number z that no other state has; sd may depend on x_{t-1}. A state is an angle
/// where its right-hand side is wrap(...) or atan2(...).
///
/// shape   states, columns: as the file has them, observations before inputs
/// cost    see Program and Interpreter
class TextModel {
 public:
  template <class S>
  using State = SmallVector<S>;
  using Proposals = std::tuple<Prior>;

  /// The model of a file with these values for its parameters, in the file's order.
  ///
  /// error   Refusal (kBadData) naming file:line and the token
  TextModel(const TextFile& file, const std::vector<double>& parameters);

  std::vector<Quantity> states() const { return parts_->states; }
  std::vector<Column> columns() const { return parts_->columns; }
  Density density() const { return parts_->transition ? Density::kState : Density::kNone; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    const SmallVector<S> draws = drawn<S>(parts_->prior_draws, draw);
    return state_from<S>(parts_->initial, 0, {.draws = draws.data()});
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    const SmallVector<S> draws = drawn<S>(parts_->draws, draw);
    return state_from<S>(parts_->next, t, {.before = before.data(), .draws = draws.data()});
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    S sum = S(0);
    for (const Program* part : parts_->seen(y.present)) {
      S term = S(0);
      part->run<S>(t, {.state = x.data(), .row = &y}, &term);
      sum = sum + term;
    }
    return sum;
  }
  template <class S>
  S log_transition(Step t, const State<S>& x, const State<S>& before) const {
    S density = S(-kInfinity);
    if (parts_->transition) parts_->transition->run<S>(t, {.state = x.data(), .before = before.data()}, &density);
    return density;
  }
  /// error   Refusal (kWrongUse) when the file has no law for an observation
  template <class S, class D>
  Row<S> observe(Step t, const State<S>& x, const Row<S>& inputs, D& draw) const {
    refuse_without_laws();
    const std::size_t observed = parts_->observed;
    SmallVector<S> draws;
    for (std::size_t k = 0; k < observed; ++k) draws.push_back(S(draw.normal()));
    std::vector<S> values(observed);
    parts_->observe.run<S>(t, {.state = x.data(), .row = &inputs, .draws = draws.data()}, values.data());
    values.insert(values.end(), inputs.values.begin() + static_cast<std::ptrdiff_t>(observed), inputs.values.end());
    return Row<S>::of(std::move(values));
  }

  /// The model's programs on blocks of particles: what an engine runs that moves and weighs whole stretches.
  template <class V>
  class Blocks {
   public:
    using R = typename V::Number;
    explicit Blocks(const TextModel& model)
        : parts_(model.parts_), initial_(parts_->initial), next_(parts_->next), all_(parts_->whole) {
      for (const Program& law : parts_->laws) laws_.emplace_back(law);
    }
    /// Moves `count` particles from particle `first` on.
    ///
    /// shape   draws[k kBlock + i], to[d][first + i]; columns filled up to whole vectors
    void initial(const R* draws, R* const* to, std::size_t first, std::size_t count) {
      initial_.run(0, nullptr, nullptr, draws, to, first, count);
    }
    void next(Step t, const R* const* before, const R* draws, R* const* to, std::size_t first, std::size_t count) {
      next_.run(t, nullptr, before, draws, to, first, count);
    }
    /// Writes log p(row | x), or adds it.
    ///
    /// shape   x[d][first + i], sums[first + i]
    void log_likelihood(Step t, const R* const* x, const Row<V>& row, R* sums, std::size_t first, std::size_t count,
                        bool add) {
      const auto seen = parts_->seen(row.present);
      if (!add && seen.size() == 1) return of(*seen[0]).run(t, &row, x, nullptr, &sums, first, count);
      if (!add) std::fill_n(sums + first, count, R(0));
      for (const Program* part : seen) {
        terms_.resize(std::max(terms_.size(), first + count + V::kLanes));
        R* terms = terms_.data();
        of(*part).run(t, &row, x, nullptr, &terms, first, count);
        for (std::size_t i = first; i < first + count; ++i) sums[i] += terms[i];
      }
    }

   private:
    Interpreter<V>& of(const Program& part) {
      return &part == &parts_->whole ? all_ : laws_[static_cast<std::size_t>(&part - parts_->laws.data())];
    }

    std::shared_ptr<const TextParts> parts_;
    Interpreter<V> initial_, next_, all_;
    std::vector<Interpreter<V>> laws_;
    AlignedVector<R> terms_;
  };

 private:
  template <class S>
  State<S> state_from(const Program& program, Step t, const Sources<S>& sources) const {
    State<S> x(parts_->states.size());
    program.run(t, sources, x.data());
    return x;
  }
  void refuse_without_laws() const;

  std::shared_ptr<const TextParts> parts_;
};

}  // namespace mote::graph

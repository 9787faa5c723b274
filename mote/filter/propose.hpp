#pragma once
/// Propose: new particles from old ones by the model or by a proposal of its own.

#include <span>

#include "mote/filter/draw_cursor.hpp"
#include "mote/filter/particles.hpp"

namespace mote {

/// Draws x_0 of every particle from the prior; the first one's draws are those of particle `offset`.
template <Model M, class R>
void draw_prior(const M& model, Particles<R>& x, const Draws& draws, Purpose purpose = Purpose::kPrior,
                std::size_t offset = 0) {
  draws.for_each<R>(purpose, offset / kBlock * kBlock, offset + x.size(), [&](std::size_t i, auto& draw) {
    const auto state = model.template initial<R>(draw);
    if (i >= offset) x.write(i - offset, state);
  });
}

/// A model that moves particles [first, last) in one call, side by side if it likes: to the states that next() gives
/// one by one.
template <class M, class R>
concept MovesAll = Model<M> &&
    requires(const M& m, Step t, const DrawPlace& from, Particles<R>& x, std::size_t first, std::size_t last) {
  m.move_all(t, from, x, first, last);
};

/// Moves particles [first, last) by the model: x_i ~ p(. | x_i), with draws from where `moves` is.
template <Model M, class R>
void move(const M& model, Step t, Particles<R>& x, DrawCursor<R>& moves, std::size_t first, std::size_t last) {
  if constexpr (MovesAll<M, R>) return model.move_all(t, moves.hand_over(), x, first, last);
  auto before = blank_state<R>(model);
  for (std::size_t i = first; i < last; ++i) {
    auto draw = moves.next();
    x.read(i, before);
    x.write(i, model.template next<R>(t, before, draw));
  }
}

/// A log density that can be used: NaN and +infinity (a state outside the model's domain) count as density zero.
inline double usable(double log_density) { return log_density < kInfinity ? log_density : -kInfinity; }

/// log [ p(x | before) / g(x | before, y) ]: 0 for the prior, which is its own proposal.
template <class R, Model M, class G>
double log_importance(const M& model, const G& proposal, Step t, const StateOf<M, R>& x, const StateOf<M, R>& before,
                      Rows<R> y) {
  if constexpr (std::is_same_v<G, Prior>) {
    return 0;
  } else {
    return usable(static_cast<double>(model.template log_transition<R>(t, x, before) -
                                      proposal.template log_density<R>(model, t, x, before, y)));
  }
}

/// Proposes particles [first, last) in place, x_i ~ g(. | x_i, y), with draws from where `moves` is, and adds
/// log [p(x_i | before) / g(x_i | before, y)] to their log weights.
///
/// source  docs/filters.md (F3), (F4); IMH-HW (4), without its likelihood factor
template <Model M, class R, class G>
void propose(const M& model, const G& proposal, Step t, Rows<R> y, Particles<R>& x, std::span<double> log_weights,
             DrawCursor<R>& moves, std::size_t first, std::size_t last) {
  if constexpr (MovesAll<M, R> && std::is_same_v<G, Prior>) return move(model, t, x, moves, first, last);
  auto before = blank_state<R>(model);
  for (std::size_t i = first; i < last; ++i) {
    auto draw = moves.next();
    x.read(i, before);
    const auto after = proposal.template propose<R>(model, t, before, y, draw);
    log_weights[i] += log_importance<R>(model, proposal, t, after, before, y);
    x.write(i, after);
  }
}

}  // namespace mote

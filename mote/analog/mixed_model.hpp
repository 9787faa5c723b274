#pragma once
/// A model whose likelihood, or whose all, is computed by analog parts: what a filter runs in mixed mode.

#include <memory>

#include "mote/analog/arithmetic.hpp"
#include "mote/filter/weigh.hpp"
#include "mote/graph/replay.hpp"

namespace mote::analog {

/// A recorded model in the arithmetic of a design. The noise of an evaluation has an address: seed, step, particle.
///
/// Moves take their noise from their own draws; weighing one particle by itself, without saying which, has no noise.
///
/// shape   double only; copies share the arithmetic: one thread at a time
/// cost    O(vertices) a call
class MixedModel {
 public:
  template <class S>
  using State = SmallVector<S>;

  /// `seed` is that of the noise.
  MixedModel(const Placement& placement, const Design& design, std::uint64_t seed)
      : arithmetic_(std::make_shared<MixedArithmetic>(placement, design)),
        replayed_(placement.recorded, arithmetic_),
        seed_(seed) {}

  std::vector<Quantity> states() const { return replayed_.states(); }
  std::vector<Column> columns() const { return replayed_.columns(); }

  template <class S, class D>
  State<S> initial(D& draw) const {
    return replayed_.template initial<S>(draw);
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    return replayed_.template next<S>(t, before, draw);
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    return replayed_.template log_likelihood<S>(t, x, y);
  }

  /// Adds log p(y | x_i) to the log weights of particles [first, N).
  void weigh_all(Step t, Rows<double> y, const Particles<double>& x, std::size_t first,
                 std::span<double> log_weights) const {
    auto state = blank_state<double>(*this);
    const Draws draws{seed_, static_cast<std::uint32_t>(t)};
    draws.for_each(kNoise, first / kBlock * kBlock, x.size(), [&](std::size_t i, Draw<double>& draw) {
      arithmetic_->draw_from(&draw);
      x.read(i, state);
      const double sum = mote::log_likelihood<double>(*this, t, state, y);
      if (i >= first) log_weights[i] += sum;
    });
    arithmetic_->draw_from(nullptr);
  }

 private:
  std::shared_ptr<MixedArithmetic> arithmetic_;
  graph::Replayed<MixedArithmetic> replayed_;
  std::uint64_t seed_;
};

}  // namespace mote::analog

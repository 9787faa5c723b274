#pragma once
/// A model whose likelihood, or whose all, is computed by analog parts: what a filter runs in mixed mode.

#include <memory>
#include <span>

#include "mote/analog/tape.hpp"
#include "mote/filter/weigh.hpp"
#include "mote/graph/drawn.hpp"

namespace mote::analog {

/// A recorded model in the arithmetic of a design. The noise of an evaluation has an address: seed, step, particle.
///
/// Moves take their noise from their own draws; weighing one particle by itself, without saying which, has no noise. A
/// row with a value missing weighs nothing: a recording is that of whole rows.
///
/// shape   double only; copies share the arithmetic: one thread at a time
/// cost    O(vertices) a call
class MixedModel {
 public:
  template <class S>
  using State = SmallVector<S>;

  /// `seed` is that of the noise.
  MixedModel(const Placement& placement, const Design& design, std::uint64_t seed)
      : shared_(std::make_shared<Shared>(placement, design)), seed_(seed) {}

  std::vector<Quantity> states() const { return shared_->recorded.states; }
  std::vector<Column> columns() const { return shared_->recorded.columns; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    const auto draws = graph::drawn<double>(shared_->recorded.prior_draws, draw);
    return computed(shared_->initial, {.draws = draws.data()});
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    const auto draws = graph::drawn<double>(shared_->recorded.draws, draw);
    return computed(shared_->next,
                    {.before = before.data(), .schedule = shared_->schedule_at(t), .draws = draws.data()});
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    for (std::size_t j = 0; j < y.values.size(); ++j)
      if (!y.seen(j)) return 0;
    double sum = 0;
    shared_->weigh.run(shared_->arithmetic,
                       {.state = x.data(), .row = y.values.data(), .schedule = shared_->schedule_at(t)}, &sum);
    return sum;
  }

  /// Adds log p(y | x_i) to the log weights of particles [first, N).
  void weigh_all(Step t, Rows<double> y, const Particles<double>& x, std::size_t first,
                 std::span<double> log_weights) const {
    auto state = blank_state<double>(*this);
    const Draws draws{seed_, static_cast<std::uint32_t>(t)};
    draws.for_each(kNoise, first / kBlock * kBlock, x.size(), [&](std::size_t i, Draw<double>& draw) {
      shared_->arithmetic.draw_from(&draw);
      x.read(i, state);
      const double sum = mote::log_likelihood<double>(*this, t, state, y);
      if (i >= first) log_weights[i] += sum;
    });
    shared_->arithmetic.draw_from(nullptr);
  }

 private:
  struct Shared {
    Shared(const Placement& placement, const Design& design)
        : recorded(placement.recorded),
          arithmetic(placement, design),
          initial(placement, arithmetic, recorded.initial),
          next(placement, arithmetic, recorded.next),
          weigh(placement, arithmetic, {recorded.log_likelihood}) {
      for (const graph::Vertex& v : recorded.graph.vertices())
        scheduled = scheduled || (v.op == graph::Op::kInput && v.role == graph::Role::kSchedule);
    }
    const double* schedule_at(Step t) {
      if (scheduled && t != step) {
        schedule = recorded.schedule(t);
        step = t;
      }
      return schedule.data();
    }

    graph::Recorded recorded;
    MixedArithmetic arithmetic;
    Tape initial, next, weigh;
    bool scheduled = false;  ///< whether anything follows t alone
    std::vector<double> schedule;
    Step step = -1;
  };

  SmallVector<double> computed(Tape& tape, const TapeInputs& inputs) const {
    SmallVector<double> x(shared_->recorded.states.size());
    tape.run(shared_->arithmetic, inputs, x.data());
    return x;
  }

  std::shared_ptr<Shared> shared_;
  std::uint64_t seed_;
};

}  // namespace mote::analog

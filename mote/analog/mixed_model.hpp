#pragma once
/// A model whose likelihood, or whose all, is computed by analog parts: what a filter runs in mixed mode.

#include <memory>
#include <span>

#include "mote/analog/tape.hpp"
#include "mote/filter/chain.hpp"
#include "mote/filter/weigh.hpp"
#include "mote/graph/drawn.hpp"

namespace mote::analog {

/// Where a particle's inputs are read; what a function does not read may be left out.
struct TapeInputs {
  const double* state = nullptr;     ///< kState
  const double* before = nullptr;    ///< kBefore
  const double* row = nullptr;       ///< kColumn
  const double* schedule = nullptr;  ///< kSchedule
  const double* draws = nullptr;     ///< the four roles of draws, by number

  void operator()(const graph::Vertex& input, double* value) const {
    switch (input.role) {
      case graph::Role::kState:
        *value = state[input.index];
        break;
      case graph::Role::kBefore:
        *value = before[input.index];
        break;
      case graph::Role::kColumn:
        *value = row[input.index];
        break;
      case graph::Role::kSchedule:
        *value = schedule[input.index];
        break;
      default:
        *value = draws[input.index];
    }
  }
};

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
    return shared_->state_by(shared_->initial, {.draws = draws.data()});
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    const auto draws = graph::drawn<double>(shared_->recorded.draws, draw);
    return shared_->state_by(shared_->next,
                             {.before = before.data(), .schedule = shared_->schedule_at(t), .draws = draws.data()});
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    if (!is_whole(y)) return 0;
    const TapeInputs inputs{.state = x.data(), .row = y.values.data(), .schedule = shared_->schedule_at(t)};
    shared_->weigh_one.run(shared_->arithmetic, inputs, nullptr, 1);
    return *shared_->weigh_one.output(0);
  }

  /// Adds log p(y | x_i) to the log weights of particles [first, N).
  void weigh_all(Step t, Rows<double> y, const Particles<double>& x, std::size_t first,
                 std::span<double> log_weights) const {
    const Draws draws{seed_, static_cast<std::uint32_t>(t)};
    const std::size_t normals = shared_->weigh.normals() * y.size();
    std::vector<double> noise(normals * kTile);
    draws.for_each(kNoise, first / kBlock * kBlock, x.size(), [&](std::size_t i, Draw<double>& draw) {
      for (std::size_t k = 0; k < normals; ++k) noise[k * kTile + i % kTile] = draw.normal();
      const bool full = i % kTile == kTile - 1 || i + 1 == x.size();
      if (full && i >= first) weigh_tile(t, y, x, {i / kTile * kTile, i + 1}, noise, first, log_weights);
    });
  }

 private:
  static constexpr std::size_t kTile = MixedArithmetic::kTile;

  struct Shared {
    Shared(const Placement& placement, const Design& design)
        : recorded(placement.recorded),
          arithmetic(placement, design),
          initial(placement, arithmetic, recorded.initial),
          next(placement, arithmetic, recorded.next),
          weigh_one(placement, arithmetic, {recorded.log_likelihood}),
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
    SmallVector<double> state_by(Tape<1>& tape, const TapeInputs& inputs) {
      tape.run(arithmetic, inputs, nullptr, 1);
      SmallVector<double> x(recorded.states.size());
      for (std::size_t d = 0; d < x.size(); ++d) x[d] = *tape.output(d);
      return x;
    }

    graph::Recorded recorded;
    MixedArithmetic arithmetic;
    Tape<1> initial, next, weigh_one;
    Tape<kTile> weigh;
    bool scheduled = false;  ///< whether anything follows t alone
    std::vector<double> schedule;
    Step step = -1;
  };

  template <class S>
  static bool is_whole(const Row<S>& y) {
    for (std::size_t j = 0; j < y.values.size(); ++j)
      if (!y.seen(j)) return false;
    return true;
  }

  /// Weighs the particles of a tile, from `first` on.
  void weigh_tile(Step t, Rows<double> y, const Particles<double>& x, Stretch tile, const std::vector<double>& noise,
                  std::size_t first, std::span<double> log_weights) const {
    std::array<double, kTile> sums{};
    const double* schedule = shared_->schedule_at(t);
    Tape<kTile>& weigh = shared_->weigh;
    for (std::size_t r = 0; r < y.size(); ++r) {
      if (!is_whole(y[r])) continue;
      const auto fill = [&](const graph::Vertex& input, double* column) {
        if (input.role == graph::Role::kState) {
          std::copy_n(x.component(input.index).begin() + static_cast<std::ptrdiff_t>(tile.first), tile.size(), column);
        } else {
          const TapeInputs common{.row = y[r].values.data(), .schedule = schedule};
          common(input, column);
          std::fill_n(column + 1, tile.size() - 1, *column);
        }
      };
      weigh.run(shared_->arithmetic, fill, noise.data() + r * weigh.normals() * kTile, tile.size());
      for (std::size_t i = 0; i < tile.size(); ++i) sums[i] += weigh.output(0)[i];
    }
    for (std::size_t i = std::max(first, tile.first); i < tile.last; ++i)
      log_weights[i] += usable(sums[i - tile.first]);
  }

  std::shared_ptr<Shared> shared_;
  std::uint64_t seed_;
};

}  // namespace mote::analog

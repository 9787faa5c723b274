#pragma once
/// A model whose likelihood, or whose all, is computed by analog parts: what a filter runs in mixed mode.

#include "mote/analog/arithmetic.hpp"
#include "mote/filter/chain.hpp"
#include "mote/filter/weigh.hpp"
#include "mote/graph/replay.hpp"

namespace mote::analog {

/// A recorded model in the arithmetic of a design. The noise of an evaluation has an address: seed, step, particle.
///
/// Moves take their noise from their own draws; weighing one particle by itself, without saying which, has no noise.
class MixedModel : public graph::Replayed<MixedArithmetic> {
  using One = graph::Replayed<MixedArithmetic>;

 public:
  /// `seed` is that of the noise.
  MixedModel(const Placement& placement, const Design& design, std::uint64_t seed)
      : One(placement.recorded, std::make_shared<MixedArithmetic>(placement, design)),
        tiles_(std::make_shared<Tiles>(placement.recorded)),
        seed_(seed) {
    tiles_->weigh.for_each([&](graph::Id id) { normals_ += arithmetic().normals(id); });
  }

  /// Moves particles [first, last).
  void move_all(Step t, const DrawPlace& from, Particles<double>& x, std::size_t first, std::size_t last) const {
    const auto place = [&](std::size_t drawn) { return first + (drawn - from.first); };
    for_each_tile(from.draws, from.purpose, recorded().draws, from.first, from.first + (last - first),
                  [&](std::size_t begin, std::size_t end, const double* numbers) {
                    move_tile(t, {place(begin), place(end)}, numbers, x);
                  });
  }
  /// Adds log p(y | x_i) to the log weights of particles [first, N).
  void weigh_all(Step t, Rows<double> y, const Particles<double>& x, std::size_t first,
                 std::span<double> log_weights) const {
    for_each_tile({seed_, static_cast<std::uint32_t>(t)}, kNoise, std::vector<bool>(normals_ * y.size(), true), first,
                  x.size(), [&](std::size_t begin, std::size_t end, const double* noise) {
                    weigh_tile(t, y, {begin, end}, noise, x, log_weights);
                  });
  }

 private:
  struct Tiles {
    explicit Tiles(const graph::Recorded& recorded)
        : next(recorded.graph, recorded.next), weigh(recorded.graph, {recorded.log_likelihood}) {}
    graph::Tape<double, kTile> next, weigh;
  };

  /// The arithmetic on columns of a tile, with what its particles differ in.
  struct Tile {
    MixedArithmetic& arithmetic;
    const Particles<double>& x;  ///< kState or kBefore, whichever the function reads
    Stretch stretch;
    graph::InputValues common;
    const double* draws = nullptr;  ///< number k of particle i at [k kTile + i]
    const double* noise = nullptr;  ///< likewise; what comes next

    void take(graph::Id id, const graph::Vertex& v, double* out, std::size_t count) const {
      using graph::Role;
      if (v.op == graph::Op::kConstant) {
        std::fill_n(out, count, v.value);
      } else if (v.role == Role::kColumn || v.role == Role::kSchedule) {
        std::fill_n(out, count, common(v));
      } else if (v.role == Role::kState || v.role == Role::kBefore) {
        std::copy_n(x.component(v.index).begin() + static_cast<std::ptrdiff_t>(stretch.first), count, out);
      } else {
        std::copy_n(draws + v.index * kTile, count, out);
        arithmetic.source(id, out, count);
      }
    }
    void compute(graph::Id id, const graph::Vertex& v, const Columns& operands, std::size_t count, double* out) {
      arithmetic.compute(id, v, operands, {noise, kTile}, count, out);
      if (noise != nullptr) noise += arithmetic.normals(id) * kTile;
    }
  };

  void move_tile(Step t, Stretch stretch, const double* numbers, Particles<double>& x) const {
    graph::Tape<double, kTile>& next = tiles_->next;
    next.run(Tile{arithmetic(), x, stretch, {.schedule = schedule(t)}, numbers}, stretch.size());
    for (std::size_t d = 0; d < x.dimensions(); ++d)
      std::copy_n(next.output(d), stretch.size(), x.component(d).begin() + static_cast<std::ptrdiff_t>(stretch.first));
  }

  void weigh_tile(Step t, Rows<double> y, Stretch stretch, const double* noise, const Particles<double>& x,
                  std::span<double> log_weights) const {
    std::array<double, kTile> sums{};
    graph::Tape<double, kTile>& weigh = tiles_->weigh;
    for (std::size_t r = 0; r < y.size(); ++r) {
      if (!is_whole(y[r])) continue;
      weigh.run(Tile{arithmetic(),
                     x,
                     stretch,
                     {.row = y[r].values.data(), .schedule = schedule(t)},
                     nullptr,
                     noise + r * normals_ * kTile},
                stretch.size());
      for (std::size_t i = 0; i < stretch.size(); ++i) sums[i] += weigh.output(0)[i];
    }
    for (std::size_t i = 0; i < stretch.size(); ++i) log_weights[stretch.first + i] += usable(sums[i]);
  }

  std::shared_ptr<Tiles> tiles_;
  std::size_t normals_ = 0;  ///< that weighing a particle by one row takes as noise
  std::uint64_t seed_;
};

}  // namespace mote::analog

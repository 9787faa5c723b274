#pragma once
/// What the filters of the SIMD engine do alike with a block of 1024 particles: move it by the model's own lines, weigh
/// it against its largest weight, and sum it.

#include <memory>
#include <optional>

#include "mote/engine/plan.hpp"
#include "mote/filter/weigh.hpp"
#include "mote/lanes/functions.hpp"
#include "mote/lanes/ready_draws.hpp"
#include "mote/software/simd/points.hpp"
#include "mote/software/simd/weighted_sums.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// Components of a model's state, where the compiler knows them; else 0.
template <class M>
inline constexpr std::size_t kComponents = [] {
  if constexpr (requires { std::tuple_size<StateOf<M, double>>::value; })
    return std::tuple_size<StateOf<M, double>>::value;
  return std::size_t{0};
}();

/// A model that has code of its own for stretches of particles, in vectors V: Blocks<V>, as graph::TextModel::Blocks.
template <class M, class V>
concept MovesBlocks = requires {
  typename M::template Blocks<V>;
};

template <class M, class V>
struct BlocksOf {
  struct Type {};
};
template <class M, class V>
requires MovesBlocks<M, V>
struct BlocksOf<M, V> {
  using Type = typename M::template Blocks<V>;
};

/// Moves, weighs and sums particles block by block; the sums of a step are added exactly, in whatever order.
///
///   x ~ g(. | x_{t-1}, y),   l = log p(y | x) + log [p(x | x_{t-1}) / g(x | x_{t-1}, y)],   w = 2^(l log2 e - shift)
///
/// shape   blocks of up to 1024 particles; R float or double
/// error   none: a density that is no number counts as zero
/// cost    O(1) a particle; a block's parents, draws and results stay in the first-level cache
/// source  docs/filters.md (F3) to (F6)
template <Model M, class R, class G>
class BlockPass {
 public:
  using V = lanes::Vector<R>;
  using State = StateOf<M, V>;
  static constexpr std::size_t kLanes = V::kLanes;
  static constexpr std::size_t kD = kComponents<M>;
  static constexpr bool kMovesBlocks = MovesBlocks<M, V>;

  enum class Source { kProposal, kModel, kPrior, kStay };  ///< where new states come from
  enum class Weights { kFresh, kCarried, kKept, kEqual };  ///< fresh and carried take in the rows' likelihood

  /// Circular mean and standard deviation of component d, an angle; weights_of(b) are those of block b, in its scale.
  template <class WeightsOf>
  [[gnu::flatten]] Moments circular_moments(const Particles<R>& x, std::size_t d, const WeightsOf& weights_of) const {
    std::array<ExactSum, 2> sums;  // of weighted cosines and sines
    for (std::size_t b = 0; b < blocks(); ++b) {
      if (!std::isfinite(sums_.shift(b))) continue;
      const R* const angles = x.component(d).data() + b * kBlock;
      const R* const weights = weights_of(b);
      V cosines(0);
      V sines(0);
      for (std::size_t j = 0; j < size_of(b); j += kLanes) {
        const V w = V::load(weights + j);
        const V angle = lanes::select(V(0) < w, V::load(angles + j), V(0));
        const auto direction = lanes::sin_cos(angle);
        cosines = lanes::fma(w, direction.cosine, cosines);
        sines = lanes::fma(w, direction.sine, sines);
      }
      const double scale = totals_.scale_of(sums_.shift(b));
      sums[0].add(scale * lanes::sum(cosines));
      sums[1].add(scale * lanes::sum(sines));
    }
    if (team_ != nullptr) team_->add(sums);
    const double c = sums[0].value() / totals_.weight;
    const double s = sums[1].value() / totals_.weight;
    return {std::atan2(s, c), std::sqrt(std::max(0.0, -2 * std::log(std::min(1.0, std::hypot(c, s)))))};
  }

  /// The weights that block b had in the last pass, in its scale, from the log weights that it left.
  ///
  /// shape   logs, weights: (1024,); zeros behind the block's last particle
  [[gnu::flatten]] void weigh_again(std::size_t b, const R* logs, R* weights) const {
    std::fill_n(weights, kBlock, R(0));
    if (!std::isfinite(sums_.shift(b))) return;
    const std::size_t n = size_of(b);
    for (std::size_t j = 0; j < n; j += kLanes)
      lanes::exp2_weight(lanes::fma(V::load(logs + j), V(std::numbers::log2e), V(-sums_.shift(b)))).store(weights + j);
    std::fill(weights + n, weights + kBlock, R(0));
  }

  /// What one share of a step works with: the states that a block starts from, where it goes, its draws.
  struct Desk {
    std::vector<AlignedVector<R>> parents;
    ColumnPointers<R, kD> columns, to;
    AlignedVector<R> log_weights;                         // where nobody asks for them
    AlignedVector<R> numbers;                             // draws made ahead
    std::optional<lanes::VectorDraw<R>> source;           // that make them
    std::optional<typename BlocksOf<M, V>::Type> blocks;  // of a model that moves blocks
    AlignedVector<R> likelihoods;                         // log p(y | x) of a block that it has weighed
    std::size_t next = 0;                                 // particle to make draws for

    explicit Desk(std::size_t dimensions)
        : parents(dimensions),
          columns(column_pointers<R, kD>(dimensions)),
          to(column_pointers<R, kD>(dimensions)),
          log_weights(kBlock),
          likelihoods(kMovesBlocks ? kBlock : 0) {
      for (std::size_t d = 0; d < dimensions; ++d) {
        parents[d].resize(kBlock);
        columns[d] = parents[d].data();
      }
    }
    /// Starts the draws of a block.
    [[gnu::noinline]] void start(const Address& address, const lanes::DrawPattern& pattern) {
      numbers.resize(std::max(numbers.size(), pattern.normal.size() * kBlock));
      source.emplace(address);
      next = address.block * kBlock;
    }
    /// Makes the draws of the next `count` particles.
    void make_ready(const lanes::DrawPattern& pattern, std::size_t count, const VectorPoints<R>* points) {
      if (points != nullptr)
        points->make_ready(*source, pattern, next, count, numbers.data());
      else
        lanes::make_ready(*source, pattern, count, numbers.data());
      next += count;
    }
  };

  /// For `particles` of this process; `team`, when not null, has `all` in all.
  BlockPass(M model, std::size_t particles, const Particles<R>& like, bool spreads, Team* team = nullptr,
            std::size_t all = 0)
      : model_(std::move(model)),
        proposal_(make_proposal<G>(model_)),
        spreads_(spreads),
        team_(team),
        sums_(particles, like.dimensions(), team, all),
        moments_(like.dimensions()) {
    note_pattern<Source::kPrior>(like);
    note_pattern<Source::kModel>(like);
  }

  const BlockSums& sums() const { return sums_; }
  const Totals& totals() const { return totals_; }
  std::size_t particles() const { return sums_.particles(); }
  std::size_t blocks() const { return sums_.blocks(); }
  std::size_t size_of(std::size_t block) const { return std::min(kBlock, particles() - block * kBlock); }
  /// Prepares for passes over another number of particles.
  void resize(std::size_t particles) {
    if (particles != sums_.particles()) sums_ = BlockSums(particles, sums_.dimensions(), team_, particles);
  }
  /// The weights that the next pass keeps are in units of 1, in every block.
  void forget_scales() {
    for (std::size_t b = 0; b < blocks(); ++b) sums_.set(b, {0, 0, 0});
  }
  /// Blocks whose sums other ranks have, where all ranks have all particles; their scales, before weigh_again().
  void leave_out(std::size_t block) { sums_.leave_out(block); }
  void complete_scales() { sums_.complete_shifts(); }
  /// Writes or reads the scales of the weights that the next pass may keep.
  void keep(Archive& archive) { archive(sums_); }
  /// Adds up what the blocks of a pass have noted.
  void add_up() {
    totals_ = sums_.totals();
    moments_known_ = false;
  }
  /// Mean and standard deviation of component d of the last pass.
  Moments moments(std::size_t d) const {
    if (!moments_known_) sums_.moments(totals_, spreads_, moments_);
    moments_known_ = true;
    return moments_[d];
  }

  /// Takes in a step's rows; `like` is any set of particles to try the model on.
  void take(Rows<double> rows, const Particles<R>& like) {
    bool same_shape = rows_.size() == rows.size();
    rows_.resize(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      same_shape = same_shape && rows_[k].present == rows[k].present;
      rows_[k].present = rows[k].present;
      rows_[k].values.resize(rows[k].values.size());
      for (std::size_t j = 0; j < rows[k].values.size(); ++j) rows_[k].values[j] = V(rows[k].values[j]);
    }
    if (!same_shape) note_pattern<Source::kProposal>(like);
  }

  /// The draws of what follows are those of points, no longer when null.
  void draw_from(const VectorPoints<R>* points) { points_ = points; }
  /// The most numbers that a particle takes in a step.
  std::size_t draws_taken() const {
    std::size_t most = 0;
    for (const lanes::DrawPattern& pattern : patterns_) most = std::max(most, pattern.normal.size());
    return most;
  }

  /// Starts the draws of a block: before block(), and best while something else is waited for.
  template <Source kSource>
  void start(Desk& desk, const Address& address) {
    desk.start(address, patterns_[static_cast<std::size_t>(kSource)]);
  }

  /// States and weights of block b at step t, and its sums: from desk.columns to desk.to, after start().
  ///
  /// shape   weights: (1024,); logs: (1024,) or null, log weights in nat, read where weights are carried, written where
  ///         the rows are taken in; mass: what carried log weights sum to, log
  ///
  /// Loops of their own make the draws, move, weigh and sum: a processor runs a short chain of operations for many
  /// vectors at once, a long one for few, and what they hand on stays in the first-level cache.
  template <Source kSource, Weights kWeights>
  void block(Desk& desk, std::size_t b, Step t, R* weights, R* logs, double mass = 0) {
    constexpr bool kWeighs = Scene<kSource, kWeights>::kWeighs;
    const std::size_t n = size_of(b);
    R* const kept = logs == nullptr ? desk.log_weights.data() : logs;
    const Scene<kSource, kWeights> scene{model_, proposal_,    t,      rows_, mass, kept, desk.likelihoods.data(),
                                         n,      desk.columns, desk.to};
    if constexpr (kMovesBlocks)
      if (!desk.blocks) desk.blocks.emplace(model_);
    const lanes::DrawPattern& pattern = patterns_[static_cast<std::size_t>(kSource)];
    const std::size_t chunk = chunk_of(pattern);
    V most(kNothing);
    for (std::size_t start = 0; start < n; start += chunk) {
      const std::size_t end = std::min(start + chunk, n);
      desk.make_ready(pattern, end - start, points_);
      if constexpr (kMovesBlocks) {
        move_block<kSource>(desk, t, start, end - start);
        if constexpr (kWeighs) weigh_block(desk, t, start, end - start);
      } else {
        move(scene, start, end, desk.numbers.data());
      }
      if constexpr (kWeighs) most = lanes::max(most, weigh(scene, start, end));
    }
    sum<kWeights>(b, kWeighs ? lanes::largest(most) : R(0), kept, weights, desk.to);
  }

 private:
  static constexpr R kNothing = -std::numeric_limits<R>::infinity();
  /// Components that are summed up together with the weights.
  static constexpr std::size_t kTogether = kD <= 4 ? kD : 0;
  /// Notes which draws a source takes for a particle; a proposal may take others when rows of another shape come.
  template <Source kSource>
  void note_pattern(const Particles<R>& like) {
    lanes::PatternDraw<V> draw;
    auto state = blank_state<V>(model_);
    for (std::size_t d = 0; d < state.size(); ++d) state[d] = V(like.component(d)[0]);
    if constexpr (kSource == Source::kProposal)
      proposal_.template propose<V>(model_, 1, state, std::span<const Row<V>>(rows_), draw);
    if constexpr (kSource == Source::kModel) model_.template next<V>(1, state, draw);
    if constexpr (kSource == Source::kPrior) model_.template initial<V>(draw);
    patterns_[static_cast<std::size_t>(kSource)] = draw.pattern();
  }

  /// Moves `count` particles from `start` on by the model's own code for blocks.
  template <Source kSource>
  static void move_block(Desk& desk, Step t, std::size_t start, std::size_t count) {
    static_assert(std::is_same_v<G, Prior>, "a model that moves blocks has no other proposal");
    if constexpr (kSource == Source::kPrior)
      desk.blocks->initial(desk.numbers.data(), desk.to.data(), start, count);
    else if constexpr (kSource == Source::kStay)
      for (std::size_t d = 0; d < desk.to.size(); ++d) std::copy_n(desk.columns[d] + start, count, desk.to[d] + start);
    else
      desk.blocks->next(t, desk.columns.data(), desk.numbers.data(), desk.to.data(), start, count);
  }

  /// Log likelihoods of `count` particles from `start` on by the model's own code for blocks.
  void weigh_block(Desk& desk, Step t, std::size_t start, std::size_t count) const {
    for (std::size_t k = 0; k < rows_.size(); ++k)
      desk.blocks->log_likelihood(t, desk.to.data(), rows_[k], desk.likelihoods.data(), start, count, k > 0);
  }

  /// Moves particles [start, end).
  template <class S>
  [[gnu::flatten, gnu::noinline]] static void move(const S& scene, std::size_t start, std::size_t end,
                                                   const R* numbers) {
    // local copies keep a small model's parameters and the pointers in registers: no store can change them
    const S here = scene;
    const std::conditional_t<std::is_trivially_copyable_v<M>, M, const M&> model = scene.model;
    for (std::size_t j = start; j < end; j += kLanes) {
      lanes::ReadyDraw<V> draw(numbers, j - start);
      here.move(model, j, draw);
    }
  }

  /// Log weights of particles [start, end); the largest in each lane, NaN aside.
  template <class S>
  [[gnu::flatten, gnu::noinline]] static V weigh(const S& scene, std::size_t start, std::size_t end) {
    const S here = scene;
    const std::conditional_t<std::is_trivially_copyable_v<M>, M, const M&> model = scene.model;
    const auto largest = [&](std::size_t j, const V& most) __attribute__((always_inline)) {
      V l = here.log_weight(model, j);
      if (__builtin_expect(j + kLanes > here.particles, 0)) l = leading(l, here.particles - j);
      l.store(here.logs + j);
      return lanes::max(l, most);
    };
    V even(kNothing);  // two maxima: each waits for its last comparison alone
    V odd(kNothing);
    std::size_t j = start;
    for (; j + kLanes < end; j += 2 * kLanes) {
      even = largest(j, even);
      odd = largest(j + kLanes, odd);
    }
    if (j < end) even = largest(j, even);
    return lanes::max(even, odd);
  }

  /// Particles of a block whose draws are made at a time: what is made ahead is to stay in the first-level cache.
  static std::size_t chunk_of(const lanes::DrawPattern& pattern) {
    return pattern.normal.size() * sizeof(R) <= 16 ? kBlock : kBlock / 4;
  }

  /// The first `count` lanes; nothing in the others.
  static MOTE_INLINE V leading(const V& l, std::size_t count) {
    alignas(64) static constexpr std::array<R, kLanes> kLane = [] {
      std::array<R, kLanes> lane{};
      for (std::size_t i = 0; i < kLanes; ++i) lane[i] = static_cast<R>(i);
      return lane;
    }();
    return lanes::select(V::load(kLane.data()) < V(static_cast<R>(count)), l, V(kNothing));
  }

  /// What moving a vector of particles needs, in one place.
  template <Source kSource, Weights kWeights>
  struct Scene {
    static constexpr bool kWeighs = kWeights == Weights::kFresh || kWeights == Weights::kCarried;
    const M& model;
    const G& proposal;
    Step t;
    std::span<const Row<V>> rows;
    double mass;
    R* logs;                ///< log weights: carried ones are read, new ones written
    const R* likelihoods;   ///< of a model that has weighed the block
    std::size_t particles;  ///< of the block
    ColumnPointers<R, kD> from, to;

    template <class F>
    static MOTE_INLINE void each_component(const State& state, const F& f) {
      if constexpr (kD > 0) {
        lanes::unrolled<kD>(f);
      } else {
        for (std::size_t d = 0; d < state.size(); ++d) f(d);
      }
    }
    MOTE_INLINE State loaded(const M& model_here, const ColumnPointers<R, kD>& columns, std::size_t j) const {
      auto state = blank_state<V>(model_here);
      each_component(state, [&](std::size_t d) { state[d] = V::load(columns[d] + j); });
      return state;
    }
    /// Moves the particles from j on.
    template <class D>
    MOTE_INLINE void move(const M& model_here, std::size_t j, D& draw) const {
      const State before = loaded(model_here, from, j);
      const auto x = [&] {
        if constexpr (kSource == Source::kProposal)
          return proposal.template propose<V>(model_here, t, before, rows, draw);
        if constexpr (kSource == Source::kModel) return model_here.template next<V>(t, before, draw);
        if constexpr (kSource == Source::kPrior) return model_here.template initial<V>(draw);
        if constexpr (kSource == Source::kStay) return before;
      }();
      each_component(x, [&](std::size_t d) {
        x[d].store(to[d] + j);
        lanes::prefetch(to[d] + j + kBlock);
      });
    }
    /// Log weights of the particles from j on, as computed: they may be NaN or infinite.
    MOTE_INLINE V log_weight(const M& model_here, std::size_t j) const {
      V l(0);
      State x;
      if constexpr (kMovesBlocks) {
        l = V::load(likelihoods + j);
      } else {
        x = loaded(model_here, to, j);
        // one call, which g++ then inlines whole, and at least one row: what it computes from parameters alone leaves
        // both loops
        std::size_t k = 0;
        do {
          l = l + model_here.template log_likelihood<V>(t, x, rows[k]);
        } while (++k < rows.size());
      }
      if constexpr (kSource == Source::kProposal && !std::is_same_v<G, Prior>) {
        const State before = loaded(model_here, from, j);
        l = usable_weights(l) + usable_weights(model_here.template log_transition<V>(t, x, before) -
                                               proposal.template log_density<V>(model_here, t, x, before, rows));
      }
      if constexpr (kWeights == Weights::kCarried) l = l + (V::load(logs + j) - V(mass));
      return l;
    }
  };

  /// Weights of one block from their logarithms, about the largest; sums of weights and states.
  template <Weights kWeights>
  void sum(std::size_t b, R top, R* logs, R* weights, const ColumnPointers<R, kD>& x) {
    constexpr bool kWeighs = kWeights == Weights::kFresh || kWeights == Weights::kCarried;
    const std::size_t n = size_of(b);
    const double shift = kWeighs                       ? std::ceil(static_cast<double>(top) * std::numbers::log2e)
                         : kWeights == Weights::kEqual ? 0
                                                       : sums_.shift(b);
    if (kWeighs && top == kNothing) {
      std::fill(weights, weights + kBlock, R(0));
      sums_.set(b, {-kInfinity, 0, 0});
      return;
    }
    if constexpr (kWeights == Weights::kEqual) {
      std::fill(weights, weights + n, R(1));
      std::fill(weights + n, weights + (n + kLanes - 1) / kLanes * kLanes, R(0));
    }
    VectorSums<R, kTogether> all;
    if (spreads_)
      add_up_weighted<true, kWeighs>(logs, shift, n, weights, x, all);
    else
      add_up_weighted<false, kWeighs>(logs, shift, n, weights, x, all);
    const WeightSums block{shift, lanes::sum(all.weight), lanes::sum(all.square)};
    if constexpr (kWeighs)
      if (!std::isfinite(block.weight)) return sum<kWeights>(b, clean_weights(logs, n), logs, weights, x);
    sums_.set(b, block);
    for (std::size_t d = 0; d < kTogether; ++d) sums_.set(b, d, all.components[d].sums(x[d], weights, n));
    for (std::size_t d = kTogether; d < x.size(); ++d) {
      CentredSums<R> other(x[d], spreads_);
      for (std::size_t j = 0; j < n; j += kLanes) other.template add<true>(V::load(weights + j), V::load(x[d] + j));
      sums_.set(b, d, other.sums(x[d], weights, n));
    }
  }

  M model_;
  G proposal_;
  bool spreads_;  // sums of squares are formed
  Team* team_;
  BlockSums sums_;
  mutable std::vector<Moments> moments_;  // of all components, once one was asked for
  mutable bool moments_known_ = false;
  Totals totals_;
  std::vector<Row<V>> rows_;
  std::array<lanes::DrawPattern, 4> patterns_;  // by source
  const VectorPoints<R>* points_ = nullptr;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

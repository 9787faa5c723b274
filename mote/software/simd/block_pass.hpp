#pragma once
/// What the filters of the SIMD engine do alike with a block of 1024 particles: move it by the model's own lines, weigh
/// it against its largest weight, and sum it.

#include <memory>
#include <optional>

#include "mote/filter/weigh.hpp"
#include "mote/lanes/draws.hpp"
#include "mote/lanes/functions.hpp"
#include "mote/software/simd/block_sums.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// Pointers to the D components of something; D = 0: as many as are known at run time.
template <class T, std::size_t kD>
using ColumnPointers = std::conditional_t<kD == 0, std::vector<T*>, std::array<T*, kD>>;

template <class T, std::size_t kD>
ColumnPointers<T, kD> column_pointers(std::size_t dimensions) {
  ColumnPointers<T, kD> all{};
  if constexpr (kD == 0) all.resize(dimensions);
  return all;
}

/// Components of a model's state, where the compiler knows them; else 0.
template <class M>
inline constexpr std::size_t kComponents = [] {
  if constexpr (requires { std::tuple_size<StateOf<M, double>>::value; })
    return std::tuple_size<StateOf<M, double>>::value;
  return std::size_t{0};
}();

/// What a filter sums up in passing.
enum class Estimates {
  kMeans,    ///< means; standard deviations are NaN
  kSpreads,  ///< means and standard deviations
};

/// Moves, weighs and sums particles block by block; the sums of a step are added in the order of the blocks.
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

  enum class Source { kProposal, kModel, kPrior, kStay };  ///< where new states come from
  enum class Weights { kFresh, kCarried, kKept, kEqual };  ///< fresh and carried take in the rows' likelihood

  /// Circular mean and standard deviation of component d, an angle; weights_of(b) are those of block b, in its scale.
  template <class WeightsOf>
  [[gnu::flatten]] Moments circular_moments(const Particles<R>& x, std::size_t d, const WeightsOf& weights_of) const {
    double c = 0;
    double s = 0;
    for (std::size_t b = 0; b < blocks(); ++b) {
      const R* const angles = x.component(d).data() + b * kBlock;
      const R* const weights = weights_of(b);
      V cosines(0);
      V sines(0);
      for (std::size_t j = 0; j < size_of(b); j += kLanes) {
        const V w = V::load(weights + j);
        const V angle = lanes::select(V(0) < w, V::load(angles + j), V(0));
        cosines = lanes::fma(w, lanes::cos(angle), cosines);
        sines = lanes::fma(w, lanes::sin(angle), sines);
      }
      const double scale = totals_.scale_of(sums_.shift(b));
      c += scale * lanes::sum(cosines);
      s += scale * lanes::sum(sines);
    }
    c /= totals_.weight;
    s /= totals_.weight;
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
    AlignedVector<R> numbers;                    // draws made ahead
    std::optional<lanes::VectorDraw<R>> source;  // that make them

    explicit Desk(std::size_t dimensions)
        : parents(dimensions), columns(column_pointers<R, kD>(dimensions)), to(column_pointers<R, kD>(dimensions)) {
      for (std::size_t d = 0; d < dimensions; ++d) {
        parents[d].resize(kBlock);
        columns[d] = parents[d].data();
      }
    }
    /// Starts the draws of a block.
    [[gnu::noinline]] void start(const Address& address, const lanes::DrawPattern& pattern) {
      numbers.resize(std::max(numbers.size(), pattern.normal.size() * kBlock));
      source.emplace(address);
    }
    /// Makes the draws of the next `count` particles.
    void make_ready(const lanes::DrawPattern& pattern, std::size_t count) {
      lanes::make_ready(*source, pattern, count, numbers.data());
    }
  };

  BlockPass(M model, std::size_t particles, const Particles<R>& like, bool spreads)
      : model_(std::move(model)),
        proposal_(make_proposal<G>(model_)),
        spreads_(spreads),
        sums_(particles, like.dimensions()) {
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
    if (particles != sums_.particles()) sums_ = BlockSums(particles, sums_.dimensions());
  }
  /// The weights that the next pass keeps are in units of 1, in every block.
  void forget_scales() {
    for (std::size_t b = 0; b < blocks(); ++b) sums_.set(b, {0, 0, 0});
  }
  /// Adds up what the blocks of a pass have noted.
  void add_up() {
    totals_ = sums_.totals();
    if (std::isfinite(totals_.reference)) expected_ = totals_.reference;
  }
  /// Mean and standard deviation of component d of the last pass.
  Moments moments(std::size_t d) const {
    Moments both = sums_.moments(totals_, d);
    if (!spreads_) both.sd = kNaN;
    return both;
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

  /// States and weights of block b, and its sums: from desk.columns to desk.to, under the step of the address.
  ///
  /// shape   weights: (1024,); logs: (1024,) or null, log weights in nat, read where weights are carried, written where
  ///         the rows are taken in; mass: what carried log weights sum to, log
  template <Source kSource, Weights kWeights>
  void block(Desk& desk, std::size_t b, const Address& address, R* weights, R* logs, double mass = 0) {
    // a state of a size that is not known lives in memory, and its loop gains nothing by being one
    if constexpr (kD > 0 && kSource == Source::kProposal && kWeights == Weights::kFresh)
      if (spreads_ ? expected_block<true>(desk, b, address, weights, logs)
                   : expected_block<false>(desk, b, address, weights, logs))
        return;
    any_block<kSource, kWeights>(desk, b, address, weights, logs == nullptr ? weights : logs, mass);
  }

 private:
  static constexpr R kNothing = -std::numeric_limits<R>::infinity();
  /// How far from 1 a block's sum of weights may be in the expected scale: squares of weights stay numbers.
  static constexpr double kLeastSum = std::is_same_v<R, float> ? 0x1p-40 : 0x1p-400;

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

  /// Sums of one component about the block's first particle.
  struct Centred {
    const R* x;
    V centre{0}, first{0}, second{0};

    explicit MOTE_INLINE Centred(const R* states) : x(states) {}
    /// Takes the first particle for the centre.
    MOTE_INLINE void centre_at(const V& states) { centre = V(usable_centre(lanes::first(states))); }
    template <bool kSpread = true>
    MOTE_INLINE void add(const V& w, const V& states) {
      if constexpr (kSpread) {
        const V offset = states - centre;
        const V moment = w * offset;
        first = first + moment;
        second = lanes::fma(moment, offset, second);
      } else {
        first = lanes::fma(w, states, first);
      }
    }
    template <bool kSpread = true>
    MOTE_INLINE ComponentSums sums(const R* weights, std::size_t n) const {
      const auto c = kSpread ? static_cast<double>(usable_centre(x[0])) : 0.0;
      const ComponentSums all{c, lanes::sum(first), lanes::sum(second)};
      return std::isfinite(all.first + all.second) ? all : careful(c, x, weights, n);
    }
    static R usable_centre(R state) { return std::isfinite(state) ? state : R(0); }
    /// Leaves out particles without weight, whose states may be anything.
    [[gnu::noinline]] static ComponentSums careful(double c, const R* x, const R* weights, std::size_t n) {
      ComponentSums all{c, 0, 0};
      for (std::size_t i = 0; i < n; ++i) {
        if (!(weights[i] > 0)) continue;
        const double offset = static_cast<double>(x[i]) - c;
        all.first += static_cast<double>(weights[i]) * offset;
        all.second += static_cast<double>(weights[i]) * offset * offset;
      }
      return all;
    }
  };

  /// One pass over a block whose largest weight is about the last step's: weights are formed as they come, in its
  /// scale. False if it was not so, or a density was no number: then nothing has been noted.
  template <bool kSpread>
  bool expected_block(Desk& desk, std::size_t b, const Address& address, R* weights, R* logs) {
    const std::size_t n = size_of(b);
    const Scene<Source::kProposal, Weights::kFresh> scene{
        model_, proposal_, static_cast<Step>(address.step), rows_, 0, nullptr, desk.columns, desk.to};
    Running<kSpread> running{V(-expected_), weights, logs, n, Centred(desk.to[0])};
    desk.start(address, patterns_[static_cast<std::size_t>(Source::kProposal)]);
    const std::size_t chunk = chunk_of<Source::kProposal>();
    for (std::size_t start = 0; start < n; start += chunk) {
      const std::size_t end = std::min(start + chunk, n);
      desk.make_ready(patterns_[0], end - start);
      expected_chunk<kSpread>(scene, start, end, desk.numbers.data(), running);
    }
    const WeightSums sums{expected_, lanes::sum(running.s), lanes::sum(running.ss)};
    if (!(sums.weight > kLeastSum && sums.weight < 1 / kLeastSum)) return false;
    sums_.set(b, sums);
    sums_.set(b, 0, running.first.template sums<kSpread>(weights, n));
    other_components(b, weights, desk.to);
    return true;
  }

  /// Weights and sums of a block as they come.
  template <bool kSpread>
  struct Running {
    V shift;
    R* weights;
    R* logs;
    std::size_t n;
    Centred first;
    V s{0}, ss{0};

    MOTE_INLINE void add(std::size_t j, const V& l, const V& x) {
      V w = lanes::exp2_weight(lanes::fma(l, V(std::numbers::log2e), shift));
      if (__builtin_expect(j + kLanes > n, 0)) w = leading(w, n - j);
      w.store(weights + j);
      if (logs != nullptr) l.store(logs + j);
      s = s + w;
      ss = lanes::fma(w, w, ss);
      if constexpr (kSpread)
        if (j == 0) first.centre_at(x);
      first.template add<kSpread>(w, x);
    }
  };

  /// The hot loop, and nothing else: so its constants leave it.
  template <bool kSpread, class S>
  [[gnu::flatten, gnu::noinline]] static void expected_chunk(const S& scene, std::size_t start, std::size_t end,
                                                             const R* numbers, Running<kSpread>& all) {
    // local copies keep a small model's parameters and the pointers in registers: no store can change them
    const S here = scene;
    const std::conditional_t<std::is_trivially_copyable_v<M>, M, const M&> model = scene.model;
    Running<kSpread> running = all;
    for (std::size_t j = start; j < end; j += kLanes) {
      lanes::ReadyDraw<V> draw(numbers, j - start);
      const auto moved = here.move(model, j, draw);
      running.add(j, moved.log_weight, moved.first);
    }
    all = running;
  }

  /// Any block: log weights first, then weights about the block's largest.
  template <Source kSource, Weights kWeights>
  [[gnu::noinline]] void any_block(Desk& desk, std::size_t b, const Address& address, R* weights, R* logs,
                                   double mass) {
    constexpr bool kWeighs = Scene<kSource, kWeights>::kWeighs;
    const std::size_t n = size_of(b);
    const Scene<kSource, kWeights> scene{model_,       proposal_, static_cast<Step>(address.step), rows_, mass, logs,
                                         desk.columns, desk.to};
    V most(kNothing);
    desk.start(address, patterns_[static_cast<std::size_t>(kSource)]);
    const std::size_t chunk = chunk_of<kSource>();
    for (std::size_t start = 0; start < n; start += chunk) {
      const std::size_t end = std::min(start + chunk, n);
      desk.make_ready(patterns_[static_cast<std::size_t>(kSource)], end - start);
      most = lanes::max(most, any_chunk(scene, start, end, desk.numbers.data(), logs, n));
    }
    sum<kWeights>(b, kWeighs ? lanes::largest(most) : R(0), logs, weights, desk.to);
  }

  template <class S>
  [[gnu::noinline]] static V any_chunk(const S& scene, std::size_t start, std::size_t end, const R* numbers, R* logs,
                                       std::size_t n) {
    const S here = scene;
    const std::conditional_t<std::is_trivially_copyable_v<M>, M, const M&> model = scene.model;
    V most(kNothing);
    for (std::size_t j = start; j < end; j += kLanes) {
      lanes::ReadyDraw<V> draw(numbers, j - start);
      V l = here.move(model, j, draw).log_weight;
      if constexpr (S::kWeighs) {
        l = usable(l);
        if (j + kLanes > n) l = lanes::select(leading_lanes(n - j), l, V(kNothing));
        l.store(logs + j);
        most = lanes::max(most, l);
      }
    }
    return most;
  }

  /// Particles of a block whose draws are made at a time: what is made ahead is to stay in the first-level cache.
  template <Source kSource>
  std::size_t chunk_of() const {
    return patterns_[static_cast<std::size_t>(kSource)].normal.size() * sizeof(R) <= 16 ? kBlock : kBlock / 4;
  }

  /// The first `count` lanes.
  static MOTE_INLINE lanes::Mask<R> leading_lanes(std::size_t count) {
    alignas(64) std::array<R, kLanes> lane{};
    for (std::size_t i = 0; i < kLanes; ++i) lane[i] = i < count ? R(1) : R(0);
    return V(0) < V::load(lane.data());
  }
  static MOTE_INLINE V leading(const V& v, std::size_t count) { return lanes::select(leading_lanes(count), v, V(0)); }

  /// What moving a vector of particles needs, in one place.
  template <Source kSource, Weights kWeights>
  struct Scene {
    static constexpr bool kWeighs = kWeights == Weights::kFresh || kWeights == Weights::kCarried;
    const M& model;
    const G& proposal;
    Step t;
    std::span<const Row<V>> rows;
    double mass;
    const R* logs;  ///< carried log weights
    ColumnPointers<R, kD> from, to;

    struct Moved {
      V log_weight;  ///< as computed: it may be NaN or infinite
      V first;       ///< component 0
    };
    template <class F>
    static MOTE_INLINE void each_component(const State& state, const F& f) {
      if constexpr (kD > 0) {
        lanes::unrolled<kD>(f);
      } else {
        for (std::size_t d = 0; d < state.size(); ++d) f(d);
      }
    }
    /// Moves the particles from j on.
    template <class D>
    MOTE_INLINE Moved move(const M& model_here, std::size_t j, D& draw) const {
      auto before = blank_state<V>(model_here);
      each_component(before, [&](std::size_t d) { before[d] = V::load(from[d] + j); });
      const auto x = [&] {
        if constexpr (kSource == Source::kProposal)
          return proposal.template propose<V>(model_here, t, before, rows, draw);
        if constexpr (kSource == Source::kModel) return model_here.template next<V>(t, before, draw);
        if constexpr (kSource == Source::kPrior) return model_here.template initial<V>(draw);
        if constexpr (kSource == Source::kStay) return before;
      }();
      each_component(before, [&](std::size_t d) { x[d].store(to[d] + j); });
      if constexpr (!kWeighs) return {V(0), x[0]};
      // at least one row, and the first outside the loop: what it computes from parameters alone leaves both loops
      V l = model_here.template log_likelihood<V>(t, x, rows[0]);
      for (std::size_t k = 1; k < rows.size(); ++k) l = l + model_here.template log_likelihood<V>(t, x, rows[k]);
      if constexpr (kSource == Source::kProposal && !std::is_same_v<G, Prior>)
        l = usable(l) + usable(model_here.template log_transition<V>(t, x, before) -
                               proposal.template log_density<V>(model_here, t, x, before, rows));
      if constexpr (kWeights == Weights::kCarried) l = l + (V::load(logs + j) - V(mass));
      return {l, x[0]};
    }
  };

  /// A density as a weight may use it: NaN and +infinity count as zero.
  static MOTE_INLINE V usable(const V& l) {
    return lanes::select(l < V(std::numeric_limits<R>::infinity()), l, V(kNothing));
  }

  /// Weights of one block from their logarithms, about the largest; sums of weights and states.
  template <Weights kWeights>
  MOTE_INLINE void sum(std::size_t b, R top, const R* logs, R* weights, const ColumnPointers<R, kD>& x) {
    constexpr bool kWeighs = kWeights == Weights::kFresh || kWeights == Weights::kCarried;
    const std::size_t n = size_of(b);
    WeightSums block;
    block.shift = kWeighs                       ? std::ceil(static_cast<double>(top) * std::numbers::log2e)
                  : kWeights == Weights::kEqual ? 0
                                                : sums_.shift(b);
    if (kWeighs && !(top > kNothing)) {
      std::fill(weights, weights + kBlock, R(0));
      sums_.set(b, {-kInfinity, 0, 0});
      return;
    }
    if constexpr (kWeights == Weights::kEqual) {
      std::fill(weights, weights + n, R(1));
      std::fill(weights + n, weights + (n + kLanes - 1) / kLanes * kLanes, R(0));
    }
    const V shift(-block.shift);
    const V log2e(std::numbers::log2e);
    V s(0);
    V ss(0);
    Centred first(x[0]);
    first.centre_at(V::load(x[0]));
    for (std::size_t j = 0; j < n; j += kLanes) {
      V w;
      if constexpr (kWeighs) {
        w = lanes::exp2_weight(lanes::fma(V::load(logs + j), log2e, shift));
        w.store(weights + j);
      } else {
        w = V::load(weights + j);
      }
      s = s + w;
      ss = lanes::fma(w, w, ss);
      first.add(w, V::load(x[0] + j));
    }
    block.weight = lanes::sum(s);
    block.square = lanes::sum(ss);
    sums_.set(b, block);
    sums_.set(b, 0, first.sums(weights, n));
    other_components(b, weights, x);
  }

  /// Sums of the components after the first.
  MOTE_INLINE void other_components(std::size_t b, const R* weights, const ColumnPointers<R, kD>& x) {
    const std::size_t n = size_of(b);
    for (std::size_t d = 1; d < x.size(); ++d) {
      Centred other(x[d]);
      other.centre_at(V::load(x[d]));
      for (std::size_t j = 0; j < n; j += kLanes) other.add(V::load(weights + j), V::load(x[d] + j));
      sums_.set(b, d, other.sums(weights, n));
    }
  }

  M model_;
  G proposal_;
  bool spreads_;  // sums of squares are formed
  BlockSums sums_;
  Totals totals_;
  std::vector<Row<V>> rows_;
  std::array<lanes::DrawPattern, 4> patterns_;  // by source
  double expected_ = 0;                         // log2 scale in which the next weights are tried
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

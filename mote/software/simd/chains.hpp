#pragma once
/// Independent Metropolis chains side by side, one a lane.
///
/// Chains lie one after the other in memory. A square of neighbouring proposals of as many chains as there are lanes is
/// turned over, so that a vector holds what decides on one proposal of each, and the chains visit it together. What
/// they accept is turned back, in bits; a chain's states are then copied along its own proposals.

#include "mote/filter/chain.hpp"
#include "mote/lanes/acceptances.hpp"
#include "mote/lanes/transpose.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// Up to kWidth<R> neighbouring chains of a layout, which run_chains() would run one by one.
///
///   accept proposal x^ after x where  l(x) < l(x^) - log u(x^)
///
/// shape   logs, log_uniforms: (Q + P N_b,); the log u of states that chains start from are overwritten
///         starts: (P,) proposal that each chain starts from, or empty: the first that it visits
/// cost    O(1) a proposal and column; a chain takes as long alone as beside others
/// source  docs/filters.md (F13), (F14)
template <class R>
class ChainGroup {
 public:
  static constexpr std::size_t kLanes = lanes::kWidth<R>;

  /// Groups that so many chains make up.
  static std::size_t groups(std::size_t chains) { return (chains + kLanes - 1) / kLanes; }

  /// The group with the chains [first, end), of which it takes no more than it has lanes.
  ChainGroup(const ChainLayout& layout, std::size_t first, std::size_t end, const R* logs, R* log_uniforms,
             std::span<const Index> starts)
      : logs_(logs), log_uniforms_(log_uniforms), chains_(std::min(kLanes, end - first)) {
    const Cut drawn(layout.draws, layout.chains);
    const Cut kept(layout.kept, layout.chains);
    std::array<R, kLanes> log_at{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t k = first + std::min(lane, chains_ - 1);  // lanes left over repeat the last chain
      burning_.part(lane, layout.draws + k * layout.burn_in, layout.draws + (k + 1) * layout.burn_in);
      keeping_.part(lane, drawn.begin(k), drawn.begin(k + 1));
      kept_[lane] = kept.begin(k);
      passed_[lane] = keeping_.length(lane) - (kept.begin(k + 1) - kept_[lane]);
      at_[lane] = !starts.empty() ? starts[k] : layout.burn_in > 0 ? burning_.begin[lane] : keeping_.begin[lane];
      if (lane < chains_) pass_over(lane, at_[lane]);
      log_at[lane] = logs_[at_[lane]];
    }
    log_at_ = V::load(log_at.data());
  }

  /// Runs the chains and writes their share of the unweighted set.
  ///
  /// shape   from: D columns of (Q + P N_b,), of the proposals; to: as many of (N,), of the set; held: (D kLanes,)
  template <class From, class To>
  ChainReport run(const From& from, const To& to, std::span<R> held) {
    stretch(burning_, [&](std::size_t i) {
      for (std::size_t lane = 0; lane < chains_; ++lane)
        if (const std::uint32_t steps = accepted_.steps(lane); steps != 0)
          at_[lane] = burning_.begin[lane] + i + static_cast<std::size_t>(std::bit_width(steps)) - 1;
    });
    for (std::size_t d = 0; d < from.size(); ++d)
      for (std::size_t lane = 0; lane < chains_; ++lane) held[d * kLanes + lane] = from[d][at_[lane]];
    const std::size_t passed = *std::max_element(passed_.begin(), passed_.end());
    const std::size_t whole = keeping_.whole();
    stretch(
        keeping_, [&](std::size_t i) __attribute__((always_inline)) {
          for (std::size_t d = 0; d < from.size(); ++d) {
            if (i + kLanes <= whole && i >= passed)
              keep_square(i, from[d], to[d], held.data() + d * kLanes);
            else
              keep_some(i, from[d], to[d], held.data() + d * kLanes);
          }
        });
    return report_;
  }

 private:
  using V = lanes::Vector<R>;
  using Square = std::array<R, kLanes * kLanes>;
  using BySteps = typename lanes::Acceptances<R>::BySteps;
  static constexpr R kNever = std::numeric_limits<R>::infinity();  // a log u that accepts nothing

  /// Proposals that the chains visit in one go.
  struct Parts {
    std::array<std::size_t, kLanes> begin{}, end{};

    void part(std::size_t lane, std::size_t from, std::size_t to) {
      begin[lane] = from;
      end[lane] = to;
    }
    std::size_t length(std::size_t lane) const { return end[lane] - begin[lane]; }
    /// Proposals that every chain has.
    std::size_t whole() const {
      std::size_t least = length(0);
      for (std::size_t lane = 1; lane < kLanes; ++lane) least = std::min(least, length(lane));
      return least;
    }
    /// Proposals of the chain that has most.
    std::size_t longest() const {
      std::size_t most = 0;
      for (std::size_t lane = 0; lane < kLanes; ++lane) most = std::max(most, length(lane));
      return most;
    }
    bool holds(std::size_t lane, std::size_t proposal) const { return begin[lane] <= proposal && proposal < end[lane]; }
  };

  /// A chain is never offered the state that it starts from.
  void pass_over(std::size_t lane, std::size_t start) {
    report_.offered += burning_.length(lane) + keeping_.length(lane);
    if (!burning_.holds(lane, start) && !keeping_.holds(lane, start)) return;
    log_uniforms_[start] = kNever;
    --report_.offered;
  }

  /// The chains visit their parts; after each square `then` is told how many proposals came before it.
  template <class Then>
  [[gnu::flatten, gnu::noinline]] void stretch(const Parts& parts, const Then& then) {
    const std::size_t longest = parts.longest();
    const std::size_t whole = parts.whole();
    if (longest == 0) return;
    const auto turn_over = [&](std::size_t i) __attribute__((always_inline)) {
      const bool inside = i + kLanes <= whole;
      const std::size_t half = i / kLanes % 2;
      turn(parts, i, inside, logs_, R(0), square_logs_[half]);
      turn(parts, i, inside, log_uniforms_, kNever, square_uniforms_[half]);
    };
    BySteps accepted;
    turn_over(0);
    for (std::size_t i = 0; i < longest; i += kLanes) {
      if (i + kLanes < longest) turn_over(i + kLanes);
      const BySteps before = accepted;
      accepted = visit(i / kLanes % 2);
      if (i > 0) take(before, i - kLanes, then);
    }
    take(accepted, (longest - 1) / kLanes * kLanes, then);
  }
  template <class Then>
  MOTE_INLINE void take(const BySteps& accepted, std::size_t i, const Then& then) {
    accepted_.turn(accepted);
    report_.accepted += accepted_.count(chains_);
    then(i);
  }

  /// Proposals i, i + 1, ... of every chain, turned over; `none` behind a chain's last.
  static MOTE_INLINE void turn(const Parts& parts, std::size_t i, bool inside, const R* column, R none,
                               Square& square) {
    const auto row = [&](std::size_t step) { return square.data() + step * kLanes; };
    if (__builtin_expect(inside, 1)) {
      lanes::transpose<R>([&](std::size_t lane) { return column + parts.begin[lane] + i; }, row);
      return;
    }
    alignas(64) Square rows;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes::load_first(column + parts.begin[lane] + i, parts.length(lane) - std::min(i, parts.length(lane)), V(none))
          .store(rows.data() + lane * kLanes);
    lanes::transpose<R>([&](std::size_t lane) { return rows.data() + lane * kLanes; }, row);
  }

  /// The chains visit a square of proposals.
  MOTE_INLINE BySteps visit(std::size_t half) {
    V log_at = log_at_;
    BySteps accepted;
    lanes::unrolled<kLanes>([&](std::size_t step) __attribute__((always_inline)) {
      const V log = V::load(square_logs_[half].data() + step * kLanes);
      const auto accepts = log_at < log - V::load(square_uniforms_[half].data() + step * kLanes);
      log_at = lanes::select(accepts, log, log_at);
      accepted.note(step, accepts);
    });
    log_at_ = log_at;
    return accepted;
  }

  /// The states that the chains hold after each proposal of a square, all of which they have and keep.
  MOTE_INLINE void keep_square(std::size_t i, const R* from, R* to, const R* held) const {
    for (std::size_t lane = 0; lane < chains_; ++lane) {
      R* const kept = to + kept_[lane] + (i - passed_[lane]);
      const R* const before = i == passed_[lane] ? held + lane : kept - 1;
      accepted_.held(lane, V::load(from + keeping_.begin[lane] + i), *before).store(kept);
    }
  }
  /// The same where a square is not whole, or not all of it is kept.
  void keep_some(std::size_t i, const R* from, R* to, R* held) const {
    for (std::size_t lane = 0; lane < chains_; ++lane) {
      const std::size_t end = std::min(i + kLanes, keeping_.length(lane));
      if (end <= i) continue;
      alignas(64) std::array<R, 2 * kLanes> states;
      const V offered = lanes::load_first(from + keeping_.begin[lane] + i, end - i, V(0));
      const R before = i > passed_[lane] ? to[kept_[lane] + (i - passed_[lane]) - 1] : held[lane];
      accepted_.held(lane, offered, before).store(states.data());
      held[lane] = states[kLanes - 1];
      const std::size_t first = std::max(i, passed_[lane]);
      if (first < end)
        lanes::store_first(V::load(states.data() + (first - i)), end - first,
                           to + kept_[lane] + (first - passed_[lane]));
    }
  }

  const R* logs_;
  R* log_uniforms_;
  std::size_t chains_;  // in use; the other lanes repeat the last one
  Parts burning_, keeping_;
  std::array<std::size_t, kLanes> kept_{};    // where a chain's kept states go
  std::array<std::size_t, kLanes> passed_{};  // states of its own part that a chain does not keep
  std::array<std::size_t, kLanes> at_{};      // proposal that a chain starts from, then the last of its burn-in
  alignas(64) std::array<Square, 2> square_logs_;
  alignas(64) std::array<Square, 2> square_uniforms_;
  lanes::Acceptances<R> accepted_;  // in the square at hand
  V log_at_;                        // log weight of the current states
  ChainReport report_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

#pragma once
/// Independent Metropolis chains side by side, one a lane.
///
/// Chains lie one after the other in memory. A square of neighbouring proposals of as many chains as there are lanes is
/// turned over, so that a vector holds one proposal of each; the chains visit it together, and the square that they
/// make of it is turned back.

#include "mote/filter/chain.hpp"
#include "mote/lanes/transpose.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// Up to kWidth<R> neighbouring chains of a layout, which run_chains() would run one by one.
///
///   accept proposal x^ after x where  l(x) < l(x^) - log u(x^)
///
/// shape   logs, log_uniforms: (Q + P N_b,); the log u of states that chains start from are overwritten
///         starts: (P,) proposal that each chain starts from, or empty: the first that it visits
///         from: kColumns columns of (Q + P N_b,) that tell of the proposals; to: as many of (N,), what they tell of
///         the unweighted set
/// cost    O(1) a proposal and column; a chain takes as long alone as beside others
/// source  docs/filters.md (F13), (F14)
template <class R, std::size_t kColumns>
class ChainGroup {
 public:
  static constexpr std::size_t kLanes = lanes::kWidth<R>;
  static constexpr std::size_t kColumnCount = kColumns;

  /// Groups that so many chains make up.
  static std::size_t groups(std::size_t chains) { return (chains + kLanes - 1) / kLanes; }

  /// The group with the chains [first, end), of which it takes no more than it has lanes.
  ChainGroup(const ChainLayout& layout, std::size_t first, std::size_t end, const R* logs, R* log_uniforms,
             const std::array<const R*, kColumns>& from, std::span<const Index> starts)
      : logs_(logs), log_uniforms_(log_uniforms), from_(from), chains_(std::min(kLanes, end - first)) {
    const Cut drawn(layout.draws, layout.chains);
    const Cut kept(layout.kept, layout.chains);
    std::array<std::size_t, kLanes> start{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t k = first + std::min(lane, chains_ - 1);  // lanes left over repeat the last chain
      burning_.part(lane, layout.draws + k * layout.burn_in, layout.draws + (k + 1) * layout.burn_in);
      keeping_.part(lane, drawn.begin(k), drawn.begin(k + 1));
      kept_[lane] = kept.begin(k);
      passed_[lane] = keeping_.length(lane) - (kept.begin(k + 1) - kept_[lane]);
      start[lane] = !starts.empty() ? starts[k] : layout.burn_in > 0 ? burning_.begin[lane] : keeping_.begin[lane];
      if (lane < chains_) pass_over(lane, start[lane]);
    }
    const auto picked = [&](const R* column) {
      std::array<R, kLanes> value{};
      for (std::size_t lane = 0; lane < kLanes; ++lane) value[lane] = column[start[lane]];
      return V::load(value.data());
    };
    log_at_ = picked(logs_);
    for (std::size_t c = 0; c < kColumns; ++c) at_[c] = picked(from_[c]);
  }

  /// Runs the chains and writes their share of the unweighted set.
  ChainReport run(const std::array<R*, kColumns>& to) {
    stretch<false>(burning_, to);
    stretch<true>(keeping_, to);
    return report_;
  }

 private:
  using V = lanes::Vector<R>;
  using Square = std::array<R, kLanes * kLanes>;
  static constexpr R kNever = std::numeric_limits<R>::infinity();  // a log u that accepts nothing

  /// Proposals that the chains visit in one go.
  struct Parts {
    std::array<std::size_t, kLanes> begin{}, end{};

    void part(std::size_t lane, std::size_t from, std::size_t to) {
      begin[lane] = from;
      end[lane] = to;
    }
    std::size_t length(std::size_t lane) const { return end[lane] - begin[lane]; }
    bool holds(std::size_t lane, std::size_t proposal) const { return begin[lane] <= proposal && proposal < end[lane]; }
  };

  /// A chain is never offered the state that it starts from.
  void pass_over(std::size_t lane, std::size_t start) {
    report_.offered += burning_.length(lane) + keeping_.length(lane);
    if (!burning_.holds(lane, start) && !keeping_.holds(lane, start)) return;
    log_uniforms_[start] = kNever;
    --report_.offered;
  }

  template <bool kKeeps>
  [[gnu::flatten, gnu::noinline]] void stretch(const Parts& parts, const std::array<R*, kColumns>& to) {
    std::size_t longest = 0;
    std::size_t whole = parts.length(0);  // proposals that every chain has
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      longest = std::max(longest, parts.length(lane));
      whole = std::min(whole, parts.length(lane));
    }
    const std::size_t passed = *std::max_element(passed_.begin(), passed_.end());
    for (std::size_t i = 0; i < longest; i += kLanes) {
      const bool inside = i + kLanes <= whole;
      turn(parts, i, inside, logs_, R(0), square_logs_);
      turn(parts, i, inside, log_uniforms_, kNever, square_uniforms_);
      for (std::size_t c = 0; c < kColumns; ++c) turn(parts, i, inside, from_[c], R(0), squares_[c]);
      visit();
      if (!kKeeps) continue;
      for (std::size_t c = 0; c < kColumns; ++c) {
        if (inside && i >= passed)
          turn_back(squares_[c], i, to[c]);
        else
          turn_some_back(parts, squares_[c], i, to[c]);
      }
    }
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

  /// The chains visit a square of proposals, which becomes that of their states.
  MOTE_INLINE void visit() {
    const std::uint32_t counted = (std::uint32_t{1} << chains_) - 1;
    V log_at = log_at_;
    std::array<V, kColumns> at = at_;
    std::size_t accepted = 0;
    lanes::unrolled<kLanes>([&](std::size_t step) {
      const V log = V::load(square_logs_.data() + step * kLanes);
      const auto accepts = log_at < log - V::load(square_uniforms_.data() + step * kLanes);
      log_at = lanes::select(accepts, log, log_at);
      lanes::unrolled<kColumns>([&](std::size_t c) {
        R* const row = squares_[c].data() + step * kLanes;
        at[c] = lanes::select(accepts, V::load(row), at[c]);
        at[c].store(row);
      });
      accepted += static_cast<std::size_t>(std::popcount(accepts.bits() & counted));
    });
    log_at_ = log_at;
    at_ = at;
    report_.accepted += accepted;
  }

  MOTE_INLINE void turn_back(const Square& square, std::size_t i, R* to) const {
    alignas(64) std::array<R, kLanes> nowhere;
    lanes::transpose<R>(
        [&](std::size_t step) { return square.data() + step * kLanes; },
        [&](std::size_t lane) { return lane < chains_ ? to + kept_[lane] + (i - passed_[lane]) : nowhere.data(); });
  }
  /// The same where a square is not whole, or not all of it is kept.
  void turn_some_back(const Parts& parts, const Square& square, std::size_t i, R* to) const {
    alignas(64) std::array<R, (kLanes + 1) * kLanes> rows;
    lanes::transpose<R>([&](std::size_t step) { return square.data() + step * kLanes; },
                        [&](std::size_t lane) { return rows.data() + lane * kLanes; });
    for (std::size_t lane = 0; lane < chains_; ++lane) {
      const std::size_t first = std::max(i, passed_[lane]);
      const std::size_t last = std::min(i + kLanes, parts.length(lane));
      if (first < last)
        lanes::store_first(V::load(rows.data() + lane * kLanes + (first - i)), last - first,
                           to + kept_[lane] + (first - passed_[lane]));
    }
  }

  const R* logs_;
  R* log_uniforms_;
  std::array<const R*, kColumns> from_;
  std::size_t chains_;  // in use; the other lanes repeat the last one
  Parts burning_, keeping_;
  std::array<std::size_t, kLanes> kept_{};    // where a chain's kept states go
  std::array<std::size_t, kLanes> passed_{};  // states of its own part that a chain does not keep
  alignas(64) Square square_logs_{};
  alignas(64) Square square_uniforms_{};
  alignas(64) std::array<Square, kColumns> squares_{};
  V log_at_;                    // log weight of the current states
  std::array<V, kColumns> at_;  // what the columns tell of them
  ChainReport report_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

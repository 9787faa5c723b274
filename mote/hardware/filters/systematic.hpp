#pragma once
/// The golden twin of rtl/filters/mote_systematic.sv: the same parents, and the cycles in which they are there.

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "mote/hardware/filters/weights.hpp"

namespace mote::hardware {

/// Cumulative sums N (w_0 + ... + w_i) of weights lowered to the last scale; the last is without bound.
std::vector<std::uint64_t> cumulative_sums(std::span<const ScaledWeight> weights);

/// The walk over cumulative sums, cycle by cycle: rows of two, up to two children a cycle.
///
///   parent of child j: the least i with sums[i] > u T + j T,  u = uniform / 2^24
///
/// source  Kitagawa 1996
class SystematicWalk {
 public:
  static constexpr std::size_t kRows = 16, kParents = 128;  ///< what the queues hold

  /// written: the cycle in which each weight is written; scale_known: that of the last scale.
  SystematicWalk(std::span<const std::uint64_t> sums, std::uint64_t total, std::uint32_t uniform,
                 std::span<const std::uint64_t> written, std::uint64_t scale_known);

  /// Whether a parent is there in this cycle.
  bool shows() const { return !parents_.empty(); }
  /// Goes on by a cycle, in which the next parent is taken if `ready`; says whether one was there.
  bool cycle(bool ready, std::uint32_t& parent);
  std::uint64_t now() const { return now_; }

 private:
  struct Entry {
    std::uint32_t first, second;
    bool pair;
  };
  bool reads() const;
  bool walk(Entry& entry, std::size_t& children);
  std::uint64_t sum(std::size_t i) const { return i < sums_.size() ? sums_[i] : UINT64_MAX; }

  std::span<const std::uint64_t> sums_, written_;
  std::uint64_t total_, threshold_, now_, walks_from_;
  std::size_t read_ = 0, walked_ = 0, left_;
  bool second_ = false;
  std::deque<std::uint64_t> rows_;  ///< the cycles from which rows show
  std::deque<Entry> parents_;
};

}  // namespace mote::hardware

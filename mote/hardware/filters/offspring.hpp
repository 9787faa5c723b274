#pragma once
/// The golden twin of rtl/filters/mote_resample.sv and its parts, mote_offspring.sv, mote_children.sv and
/// mote_reciprocal.sv: the same parents, and the cycles in which they are there.

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "mote/hardware/filters/weights.hpp"

namespace mote::hardware {

/// 2^35 / x to 13 bits, never too large.
///
/// shape   x: 18 bits, the top one set
std::uint32_t reciprocal_of(std::uint32_t x);

/// How many children the particles up to each have together: floor(C_i N / T + v), C_i / T as 17 bits; the last: N. Of
/// weights at the last one's scale, cut, no C_i is above T.
///
/// shape   weights: (N); result: (N), not decreasing
/// error   the last particle gains below N 2^-13 children, the others lose as many together
struct Offspring {
  unsigned weight_bits;  ///< of a weight
  unsigned count_bits;   ///< N <= 2^count_bits

  std::vector<std::uint32_t> ends(std::span<const ScaledWeight> weights, std::uint64_t total,
                                  std::uint32_t uniform) const;
};

/// The parent of each child: the first particle whose end is above the child's number.
std::vector<std::uint32_t> parents_of(std::span<const std::uint32_t> ends);

/// Cycles that reading weights waits for N / T, the second of two products, where those take longer than one.
constexpr std::uint64_t factor_wait(unsigned product_latency) { return 2 * std::uint64_t{product_latency - 1}; }

/// The walk over ends, cycle by cycle: rows of 2 lanes particles in, groups of `lanes` children out.
class ChildrenWalk {
 public:
  static constexpr std::size_t kRows = 32;  ///< what the queue holds

  /// last_write: the cycle in which the last weight is written.
  ChildrenWalk(std::span<const std::uint32_t> ends, unsigned lanes, std::uint64_t last_write, unsigned product_latency);

  /// Whether a group is there in this cycle.
  bool shows() const { return shows_; }
  /// Goes on by a cycle, in which the next group is taken if `ready`; says whether one was there.
  bool cycle(bool ready);
  std::uint64_t now() const { return now_; }

 private:
  struct Arrival {
    std::uint64_t cycle;
    std::size_t row;
  };
  std::uint32_t end_of(std::size_t row) const;
  bool looks();

  std::span<const std::uint32_t> ends_;
  std::size_t lanes_, rows_, latency_, read_ = 0, room_ = kRows, freed_ = 0;
  std::uint64_t now_;
  std::uint32_t first_ = 0;     ///< child of the group
  bool looked_ = false;         ///< a group was found in the rows, which several lanes show a cycle later
  bool shows_ = false;          ///< a group
  std::deque<Arrival> flying_;  ///< rows on their way
  std::deque<std::size_t> queue_, window_;
};

}  // namespace mote::hardware

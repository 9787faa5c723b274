#pragma once
/// The golden twin of rtl/filters/mote_roulette.sv: the same parents, and the cycles in which they are there.

#include <vector>

#include "mote/hardware/filters/parent_walk.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {

/// A random number for each child against the cumulative sums.
///
///   parent: the least i with w_0 + ... + w_i > floor(u T), u of 24 bits; sums as they were taken, lowered to the last
///   scale
///
/// shape   count_bits: At of the circuit, whose search has as many levels
/// source  FPGA, sec. II
class RouletteWalk final : public ParentWalk {
 public:
  /// Draws a word for each child.
  RouletteWalk(const Weighed& weighed, unsigned count_bits, Words& words, unsigned product_latency);

  bool shows() const override { return taken_ < parents_.size() && now_ >= first_ + taken_; }
  bool cycle(bool ready, std::vector<std::uint32_t>& parents) override;
  std::uint64_t now() const override { return now_; }

 private:
  std::vector<std::uint32_t> parents_;
  std::uint64_t now_, first_;
  std::size_t taken_ = 0;
};

}  // namespace mote::hardware

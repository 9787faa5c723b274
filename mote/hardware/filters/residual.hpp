#pragma once
/// The golden twin of rtl/filters/mote_residual_systematic.sv: the same parents, and the cycles in which they are
/// there.

#include <deque>
#include <vector>

#include "mote/hardware/filters/offspring.hpp"
#include "mote/hardware/filters/parent_walk.hpp"

namespace mote::hardware {

/// Residual-systematic resampling, a weight a cycle. Its children are those of Offspring: what a weight's part of T
/// lacks of a whole child is carried to the next, which adds up to the parts of the cumulative sums.
///
/// shape   uniform: 24 bits
/// source  Bolic, Djuric & Hong 2003
class ResidualWalk final : public ParentWalk {
 public:
  static constexpr std::size_t kParents = 128;  ///< what the queue holds

  ResidualWalk(const Weighed& weighed, const Offspring& offspring, std::uint32_t uniform, unsigned product_latency);

  bool shows() const override { return !parents_.empty(); }
  bool cycle(bool ready, std::vector<std::uint32_t>& parents) override;
  std::uint64_t now() const override { return now_; }

 private:
  std::uint32_t children(std::size_t i) const { return ends_[i] - (i == 0 ? 0 : ends_[i - 1]); }

  std::vector<std::uint32_t> ends_;  ///< how many children the particles up to each have together
  std::uint64_t now_, latency_;      ///< latency: from reading a weight to its children
  std::size_t read_ = 0, arrived_ = 0, room_ = kParents;
  std::uint32_t shown_ = 0;           ///< of the first parent's children
  std::deque<std::uint64_t> flying_;  ///< the cycles in which weights that are read arrive
  std::deque<std::uint32_t> parents_;
};

}  // namespace mote::hardware

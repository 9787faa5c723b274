#pragma once
/// What every resampler of a circuit offers its golden model: the parents of a step's children, cycle by cycle.

#include <cstdint>
#include <span>
#include <vector>

#include "mote/hardware/filters/weights.hpp"

namespace mote::hardware {

/// What a step leaves to resample from.
///
/// shape   weights: (n), n >= 1, a multiple of the lanes; written: (n / lanes)
struct Weighed {
  std::span<const ScaledWeight> weights;
  std::uint64_t total;                     ///< their sum, at the scale of the last
  std::span<const std::uint64_t> written;  ///< the cycle in which each slot's weights are written
};

/// Parents in the order of the children, one for each lane at a time.
class ParentWalk {
 public:
  ParentWalk() = default;
  virtual ~ParentWalk() = default;
  ParentWalk(const ParentWalk&) = delete;
  ParentWalk(ParentWalk&&) = delete;
  ParentWalk& operator=(const ParentWalk&) = delete;
  ParentWalk& operator=(ParentWalk&&) = delete;

  /// Whether the next parents are there in this cycle.
  virtual bool shows() const = 0;
  /// Goes on by a cycle, in which the next parents are taken if `ready`, and put behind `parents`; says whether they
  /// were.
  virtual bool cycle(bool ready, std::vector<std::uint32_t>& parents) = 0;
  virtual std::uint64_t now() const = 0;
};

}  // namespace mote::hardware

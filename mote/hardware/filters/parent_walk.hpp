#pragma once
/// What every resampler of a circuit offers its golden model: the parents of a step's children, cycle by cycle.

#include <cstdint>
#include <span>

#include "mote/hardware/filters/weights.hpp"

namespace mote::hardware {

/// What a step leaves to resample from.
///
/// shape   weights, written: (n), n >= 1
struct Weighed {
  std::span<const ScaledWeight> weights;
  std::uint64_t total;                     ///< their sum, at the scale of the last
  std::span<const std::uint64_t> written;  ///< the cycle in which each weight is written
};

/// Parents in the order of the children, each there from some cycle on; `now` begins early enough for all of them.
class ParentWalk {
 public:
  ParentWalk() = default;
  virtual ~ParentWalk() = default;
  ParentWalk(const ParentWalk&) = delete;
  ParentWalk(ParentWalk&&) = delete;
  ParentWalk& operator=(const ParentWalk&) = delete;
  ParentWalk& operator=(ParentWalk&&) = delete;

  /// Whether a parent is there in this cycle.
  virtual bool shows() const = 0;
  /// Goes on by a cycle, in which the next parent is taken if `ready`; says whether one was there and taken.
  virtual bool cycle(bool ready, std::uint32_t& parent) = 0;
  virtual std::uint64_t now() const = 0;
};

}  // namespace mote::hardware

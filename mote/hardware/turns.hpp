#pragma once
/// The schedule of a pipeline that takes a row every k clocks: operators of a kind take turns at one instance.

#include <cstddef>
#include <vector>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// Modulo scheduling. An operator that starts in clock s of its row is at its instance in all clocks s + j k, so an
/// instance serves up to k operators, each at a phase s mod k of its own. Instances are operators of initiation
/// interval 1 and keep their latency; what comes out of one in a clock belongs to the operator that went in `latency`
/// clocks before.
///
/// source  Rau & Glaeser 1981, "Some scheduling techniques and an easily schedulable horizontal architecture"
class Turns {
 public:
  /// An instance: wide enough for all that take turns at it.
  struct Instance {
    static constexpr std::size_t kNobody = ~std::size_t{0};

    Circuit circuit;
    std::vector<std::size_t> taker;  ///< by phase: an operator's number, or kNobody
    std::size_t takers() const;
  };

  /// shape   interval >= 1
  explicit Turns(int interval) : interval_(interval) {}

  int interval() const { return interval_; }
  const std::vector<Instance>& instances() const { return instances_; }
  /// Whether operators choose among operands anywhere.
  bool any() const;

  /// The clock in which an operator starts whose operands are there from `ready` on: the first that is free at an
  /// instance of its kind, at most k - 1 later, of several the one most alike; where all are taken, the first at a new
  /// instance. So there are as few instances as k allows. Clock 0 stays free: the phase is known a clock after a row
  /// went in.
  ///
  /// cost    O(k instances)
  int take(std::size_t taker, const Circuit& circuit, int ready);

 private:
  int interval_;
  std::vector<Instance> instances_;
};

}  // namespace mote::hardware

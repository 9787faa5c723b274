#pragma once
/// A function of a plan, evaluated in double with its derivatives.

#include <vector>

#include "mote/hardware/datapath/plan.hpp"

namespace mote::hardware {

/// Values of a part's vertices at one call, and slopes of a result by all of them.
///
/// cost    a pass over the part's vertices each
class Tape {
 public:
  Tape(const Plan& plan, const graph::Recorded& recorded, Part part);

  void evaluate(const Samples::Call& call);
  /// d result / d vertex at the last call, for all vertices of the part; not finite where a function has a kink there.
  void differentiate(graph::Id result);

  const std::vector<graph::Id>& order() const { return order_; }
  double value(graph::Id id) const { return values_[id]; }
  double slope(graph::Id id) const { return slopes_[id]; }

 private:
  const graph::Graph& graph_;
  std::vector<graph::Id> order_;
  std::vector<graph::Id> source_;  ///< by vertex: the recording's input; itself beyond for what is always 1
  std::vector<double> values_, slopes_;
};

}  // namespace mote::hardware

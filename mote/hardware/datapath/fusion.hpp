#pragma once
/// Functions of one number in a plan: what a single table may compute.

#include <functional>
#include <map>

#include "mote/hardware/datapath/plan.hpp"
#include "mote/hardware/datapath/precision.hpp"
#include "mote/hardware/datapath/tables.hpp"
#include "mote/hardware/functions.hpp"

namespace mote::hardware {

/// A vertex that one table computes from another.
struct Fused {
  graph::Id source = 0;
  FunctionTable unit;
};

/// The vertices, by number, whose operators back to another vertex cost more than a table in their place.
///
/// A vertex is a function of another where all paths from it to inputs lead through that one (its dominator). From the
/// results down, each takes the table that spares most; error at most a step of the vertex's format.
///
/// source  dominators: Cooper, Harvey & Kennedy 2001
std::map<graph::Id, Fused> fused(const Plan& plan, const Precision& precision, const FunctionOptions& options);

/// The value of a vertex from that of another which it is a function of.
std::function<double(double)> function_between(const Plan& plan, graph::Id source, graph::Id root);

/// About what an operator takes, in look-up tables, its clocks included.
int operator_cost(const Plan& plan, const Precision& precision, graph::Id id);

}  // namespace mote::hardware

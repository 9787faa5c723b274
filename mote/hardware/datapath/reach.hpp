#pragma once
/// How far a filter's particles go, and which of them have run away.

#include "mote/hardware/datapath/plan.hpp"

namespace mote::hardware {

/// The samples without particles that have run away: in a model that is unstable from somewhere on, such as x' = x^2,
/// a few particles get beyond any word until they are resampled, and would alone decide on ranges and steps.
///
/// A call is left out where a state that it reads or makes is further from the middle half of what the samples' moves
/// make of it than 256 times that half is long, or is no number.
///
/// error   none; samples stay as they are of a part of which no call would be left
/// cost    O(samples vertices)
Samples within_reach(const Plan& plan, const graph::Recorded& recorded, const Samples& samples);

}  // namespace mote::hardware

#pragma once
/// Angles whose mean is that of their directions.

#include <cstdint>
#include <vector>

#include "mote/hardware/datapath/plan.hpp"

namespace mote::hardware {

/// States of the model that are angles and come within 0.14 of half a turn in the samples: there the mean of the
/// numbers is no mean of the angles, pi - 0.1 and -pi + 0.1 have 0.
///
/// cost    O(samples vertices)
std::vector<std::uint32_t> turning_states(const graph::Recorded& recorded, const Samples& samples);

/// The recording with two states more for each of these, behind the model's: the cosine and the sine of the angle,
/// which nothing reads, so that a circuit has their means. The angle's mean is atan2 of them.
graph::Recorded with_directions(graph::Recorded recorded, const std::vector<std::uint32_t>& turning);
/// The samples of it: the errors of a direction count as its angle's.
Samples with_directions(Samples samples, const std::vector<std::uint32_t>& turning);

}  // namespace mote::hardware

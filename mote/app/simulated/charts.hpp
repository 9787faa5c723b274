#pragma once
/// The charts of a sweep.

#include "mote/app/simulated/publication.hpp"

namespace mote::simulated {

/// Time and speed-up over the workers of a stage, with the latency laws; or speed-up and efficiency over the ranks, and
/// where a sweep has rivals time and bytes beside theirs.
std::vector<report::Chart> charts_of(const Sweep& sweep);

}  // namespace mote::simulated

#pragma once
/// What a step on a cluster is predicted to take, from the times of its stages and of its messages, without a
/// simulation.

#include <optional>

#include "mote/app/simulated/sweep.hpp"

namespace mote::simulated {

/// Seconds of a step whose stages have ranks of their own.
///
///   the exact schedule of the blocks, each a message of alpha + beta bytes, to the weigher and to the chain
///   + SISR: its barrier N T_d   + what rank 0 tells all: the verdict, the set that the next step starts from
///
/// with alpha two links' latency and 1/beta a link's bandwidth. Several chains count as one that is as much quicker.
///
/// error   none; nothing for platforms whose messages do not all cross two links: rings, files
/// cost    as design::schedule()
std::optional<double> predicted_by_stages(const Platform& platform, const Workload& work, const Cast& cast);

/// Seconds of a step of SISR on ranks that share its particles.
///
///   N/R (T_p + T_w + T_d)   + what it waits for: sums of blocks, children (as many as weights of independent blocks
///   let cross a border of two ranks)
///
/// error   none; nothing for other filters, and as above
std::optional<double> predicted_on_shares(const Platform& platform, const Workload& work, std::size_t ranks);

}  // namespace mote::simulated

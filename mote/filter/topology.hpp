#pragma once
/// Topology: how particles are cut into groups, and which groups are neighbours.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mote/filter/options.hpp"

namespace mote {

/// N particles cut into K contiguous groups whose sizes differ by at most one, the larger ones first.
class Groups {
 public:
  Groups(std::size_t particles, std::size_t groups) : particles_(particles), groups_(groups) {}
  std::size_t particles() const { return particles_; }
  std::size_t count() const { return groups_; }
  std::size_t first(std::size_t k) const { return k * (particles_ / groups_) + std::min(k, particles_ % groups_); }
  std::size_t size(std::size_t k) const { return first(k + 1) - first(k); }
  /// The group that a particle is in.
  std::size_t of(std::size_t particle) const {
    const std::size_t small = particles_ / groups_;
    const std::size_t large = particles_ % groups_;
    const std::size_t in_large = large * (small + 1);
    return particle < in_large ? particle / (small + 1) : large + (particle - in_large) / small;
  }

 private:
  std::size_t particles_, groups_;
};

/// The groups that group k sends to, each once; every group sends to as many as it receives from.
///
///   ring           k + 1
///   bidirectional  k + 1, k - 1
///   torus          right, left, below, above on a grid of r rows, r the largest divisor of K up to sqrt K
///   hypercube      k xor 2^b,  b = turn mod log2 K: one dimension after another
///
/// What is named twice (k + 1 and k - 1 of two groups, below and above in two rows) is one neighbour; k itself is none.
///
/// shape   k < groups; a power of two for kHypercube
/// source  docs/filters.md (F24a)
std::vector<std::size_t> neighbours(Topology topology, std::size_t groups, std::size_t k, std::size_t turn);

/// The number of them, the same for every group and turn.
std::size_t degree(Topology topology, std::size_t groups);

}  // namespace mote

#pragma once
/// Share: which particles of a filter a process has.

#include <cstdint>

#include "mote/base/draws.hpp"
#include "mote/engine/team.hpp"
#include "mote/filter/chain.hpp"

namespace mote {

/// Whole blocks of 1024 that N particles make up.
inline std::size_t blocks_of(std::size_t particles) { return (particles + kBlock - 1) / kBlock; }

/// The particles of one rank: a run of blocks, the first ranks with one block more where they cannot be shared evenly.
struct Share {
  std::size_t all;    ///< N, particles of the whole team
  std::size_t first;  ///< the first of this rank, at a block's beginning
  std::size_t count;

  Share(std::size_t particles, std::size_t ranks, std::size_t rank) : all(particles) {
    const Cut blocks(blocks_of(particles), ranks);
    first = blocks.begin(rank) * kBlock;
    count = std::min(blocks.begin(rank + 1) * kBlock, particles) - first;
  }
  /// All of them, where there is no team.
  Share(std::size_t particles, const Team* team)
      : Share(particles, team == nullptr ? 1 : team->ranks(), team == nullptr ? 0 : team->rank()) {}

  std::size_t first_block() const { return first / kBlock; }
  std::size_t end() const { return first + count; }
};

}  // namespace mote

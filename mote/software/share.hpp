#pragma once
/// Share: which particles of a filter a process has.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

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

/// What each rank has of a column: rank r the elements [begins[r], begins[r + 1]).
inline std::vector<std::size_t> begins_of_shares(std::size_t particles, std::size_t ranks) {
  std::vector<std::size_t> begins(ranks + 1, particles);
  for (std::size_t r = 0; r < ranks; ++r) begins[r] = Share(particles, ranks, r).first;
  return begins;
}

/// The blocks of a step that a rank makes, and those whose sums it leaves to others: where several make a block the
/// lowest counts it.
///
/// cost    O(blocks + ranks), if ranks share no more than the outer blocks of their stretches
struct BlockShare {
  std::vector<std::size_t> made, left_out;

  /// From the stretches of particles that each rank works on, a few: stretches_of(r).
  template <class Stretches>
  BlockShare(std::size_t blocks, std::size_t rank, const Stretches& stretches_of) {
    std::vector<std::size_t> lowest(blocks, rank + 1);  // of the ranks up to this one that make the block
    std::vector<bool> makes(blocks);
    for (std::size_t r = 0; r <= rank; ++r)
      for (const Stretch& stretch : stretches_of(r))
        for (std::size_t b = stretch.first / kBlock; stretch.size() > 0 && b * kBlock < stretch.last; ++b) {
          lowest[b] = std::min(lowest[b], r);
          if (r == rank) makes[b] = true;
        }
    for (std::size_t b = 0; b < blocks; ++b) {
      if (makes[b]) made.push_back(b);
      if (lowest[b] != rank) left_out.push_back(b);
    }
  }
};

/// The chains of one rank: a run of them, the first ranks with one more where they cannot be shared evenly.
struct ChainShare {
  Cut chains;
  std::size_t rank, ranks;
  ChainLayout layout;

  ChainShare(const ChainLayout& all, const Team* team)
      : chains(all.chains, team == nullptr ? 1 : team->ranks()),
        rank(team == nullptr ? 0 : team->rank()),
        ranks(team == nullptr ? 1 : team->ranks()),
        layout(all) {}

  std::size_t first() const { return chains.begin(rank); }
  std::size_t end() const { return chains.begin(rank + 1); }
  /// Where the chains of each rank begin in what P chains make of n.
  std::vector<std::size_t> begins(std::size_t n) const {
    std::vector<std::size_t> all;
    for (std::size_t r = 0; r <= ranks; ++r) all.push_back(Cut(n, layout.chains).begin(chains.begin(r)));
    return all;
  }
  /// The proposals that the chains of rank r visit: those that may be kept, those that are burnt in by.
  std::array<Stretch, 2> visited(std::size_t r) const {
    const Cut drawn(layout.draws, layout.chains);
    const std::size_t begin = chains.begin(r);
    const std::size_t end = chains.begin(r + 1);
    return {{{drawn.begin(begin), drawn.begin(end)},
             {layout.draws + begin * layout.burn_in, layout.draws + end * layout.burn_in}}};
  }
  /// Whether a chain of rank r visits proposal j.
  bool visits(std::size_t r, std::size_t j) const {
    const auto [drawn, burning] = visited(r);
    return drawn.has(j) || burning.has(j);
  }
};

}  // namespace mote

#pragma once
/// Share: which particles of a filter a process has.

#include <cstdint>
#include <numeric>
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
struct BlockShare {
  std::vector<std::size_t> made, left_out;

  /// From whether rank r makes block b.
  template <class Makes>
  BlockShare(std::size_t blocks, std::size_t rank, const Makes& makes) {
    for (std::size_t b = 0; b < blocks; ++b) {
      if (makes(rank, b)) made.push_back(b);
      std::size_t lowest = 0;
      while (lowest < rank && !makes(lowest, b)) ++lowest;
      if (lowest < rank || !makes(rank, b)) left_out.push_back(b);
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
  /// Whether a chain of rank r visits proposal j.
  bool visits(std::size_t r, std::size_t j) const { return visits(r, j, j + 1); }
  /// Whether a chain of rank r visits one of the proposals [from, to).
  bool visits(std::size_t r, std::size_t from, std::size_t to) const {
    const Cut drawn(layout.draws, layout.chains);
    const auto meets = [&](std::size_t begin, std::size_t end) { return std::max(begin, from) < std::min(end, to); };
    return meets(drawn.begin(chains.begin(r)), drawn.begin(chains.begin(r + 1))) ||
           meets(layout.draws + chains.begin(r) * layout.burn_in, layout.draws + chains.begin(r + 1) * layout.burn_in);
  }
};

}  // namespace mote

#include "mote/software/share.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

ChainShare share_of(const ChainLayout& layout, std::size_t ranks, std::size_t rank) {
  ChainShare share(layout, nullptr);
  share.chains = Cut(layout.chains, ranks);
  share.ranks = ranks;
  share.rank = rank;
  return share;
}

BlockShare blocks_of_chains(const ChainShare& share) {
  return {blocks_of(share.layout.proposals()), share.rank, [&](std::size_t r) { return share.visited(r); }};
}

/// As BlockShare, from the definition: every block is asked of every rank.
struct ByDefinition {
  std::vector<std::size_t> made, left_out;

  explicit ByDefinition(const ChainShare& share) {
    const auto makes = [&](std::size_t r, std::size_t b) {
      const std::size_t end = std::min((b + 1) * kBlock, share.layout.proposals());
      for (std::size_t j = b * kBlock; j < end; ++j)
        if (share.visits(r, j)) return true;
      return false;
    };
    for (std::size_t b = 0; b < blocks_of(share.layout.proposals()); ++b) {
      if (makes(share.rank, b)) made.push_back(b);
      std::size_t lowest = 0;
      while (lowest <= share.rank && !makes(lowest, b)) ++lowest;
      if (lowest != share.rank) left_out.push_back(b);
    }
  }
};

TEST(BlockShare, IsThatOfItsDefinition) {
  for (const ChainLayout& layout :
       {ChainLayout{9000, 9000, 9, 0}, ChainLayout{9000, 9000, 9, 100}, ChainLayout{3000, 20000, 40, 1},
        ChainLayout{4096, 4096, 8, 1024}, ChainLayout{5000, 5001, 300, 7}, ChainLayout{2048, 2048, 2, 0}})
    for (const std::size_t ranks : {1, 2, 3, 8})
      for (std::size_t rank = 0; rank < std::min(ranks, layout.chains); ++rank) {
        const ChainShare share = share_of(layout, std::min(ranks, layout.chains), rank);
        const BlockShare blocks = blocks_of_chains(share);
        const ByDefinition expected(share);
        EXPECT_EQ(blocks.made, expected.made) << layout.draws << " proposals, rank " << rank << " of " << ranks;
        EXPECT_EQ(blocks.left_out, expected.left_out) << layout.draws << " proposals, rank " << rank << " of " << ranks;
      }
}

TEST(BlockShare, CountsWhatSeveralMakeOnce) {
  const ChainLayout layout{3000, 3000, 3, 0};  // chains of 1000: blocks 0 and 1 hold two chains' proposals each
  EXPECT_EQ(blocks_of_chains(share_of(layout, 3, 0)).made, std::vector<std::size_t>({0}));
  EXPECT_EQ(blocks_of_chains(share_of(layout, 3, 0)).left_out, std::vector<std::size_t>({1, 2}));
  EXPECT_EQ(blocks_of_chains(share_of(layout, 3, 1)).made, std::vector<std::size_t>({0, 1}));
  EXPECT_EQ(blocks_of_chains(share_of(layout, 3, 1)).left_out, std::vector<std::size_t>({0, 2}));
  EXPECT_EQ(blocks_of_chains(share_of(layout, 3, 2)).made, std::vector<std::size_t>({1, 2}));
  EXPECT_EQ(blocks_of_chains(share_of(layout, 3, 2)).left_out, std::vector<std::size_t>({0, 1}));
}

// A rank that asked every block of every other would be at it for hours.
TEST(BlockShare, CostsBlocksAndRanks) {
  constexpr std::size_t kRanks = 100'000;
  const ChainLayout layout{kRanks * kBlock, kRanks * kBlock, kRanks, 0};
  const BlockShare last = blocks_of_chains(share_of(layout, kRanks, kRanks - 1));
  EXPECT_EQ(last.made, std::vector<std::size_t>({kRanks - 1}));
  EXPECT_EQ(last.left_out.size(), kRanks - 1);
}

}  // namespace
}  // namespace mote

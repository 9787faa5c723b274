#include "mote/filter/topology.hpp"

#include <set>

#include <gtest/gtest.h>

namespace mote {
namespace {

using Places = std::vector<std::size_t>;

constexpr Topology kAll[] = {Topology::kRing, Topology::kBidirectional, Topology::kTorus, Topology::kHypercube};

TEST(Groups, DifferByAtMostOne) {
  const Groups groups(11, 3);
  EXPECT_EQ(groups.first(0), 0U);
  EXPECT_EQ(groups.first(1), 4U);
  EXPECT_EQ(groups.first(2), 8U);
  EXPECT_EQ(groups.first(3), 11U);
  EXPECT_EQ(groups.size(2), 3U);
}

TEST(Groups, FindThatOfAParticle) {
  for (const std::size_t n : {1U, 7U, 11U, 12U, 64U})
    for (std::size_t count = 1; count <= n; ++count) {
      const Groups groups(n, count);
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = groups.first(k); i < groups.first(k + 1); ++i)
          ASSERT_EQ(groups.of(i), k) << n << ' ' << count << ' ' << i;
    }
}

TEST(Topology, NamesTheNeighbours) {
  EXPECT_EQ(neighbours(Topology::kRing, 5, 4, 0), (Places{0}));
  EXPECT_EQ(neighbours(Topology::kBidirectional, 5, 0, 0), (Places{1, 4}));
  // 0 1 2 3
  // 4 5 6 7
  // 8 9 10 11
  EXPECT_EQ(neighbours(Topology::kTorus, 12, 5, 0), (Places{6, 4, 9, 1}));
  EXPECT_EQ(neighbours(Topology::kTorus, 12, 3, 0), (Places{0, 2, 7, 11}));
  EXPECT_EQ(neighbours(Topology::kHypercube, 8, 5, 0), (Places{4}));
  EXPECT_EQ(neighbours(Topology::kHypercube, 8, 5, 1), (Places{7}));
  EXPECT_EQ(neighbours(Topology::kHypercube, 8, 5, 2), (Places{1}));
  EXPECT_EQ(neighbours(Topology::kHypercube, 8, 5, 3), (Places{4})) << "the first dimension again";
}

TEST(Topology, NamesEachNeighbourOnceAndNeverTheGroupItself) {
  EXPECT_EQ(neighbours(Topology::kBidirectional, 2, 0, 0), (Places{1}));
  EXPECT_EQ(neighbours(Topology::kTorus, 8, 1, 0), (Places{2, 0, 5})) << "two rows of four";
  EXPECT_EQ(neighbours(Topology::kTorus, 7, 0, 0), (Places{1, 6})) << "a prime is one row";
  for (const Topology topology : kAll) EXPECT_TRUE(neighbours(topology, 1, 0, 0).empty());
}

// Every group must receive as many as it sends, and as many as every other: inboxes are of one size.
TEST(Topology, IsRegular) {
  for (const Topology topology : kAll)
    for (std::size_t groups = 2; groups <= 64; groups += topology == Topology::kHypercube ? groups : 1)
      for (std::size_t turn = 0; turn < 6; ++turn) {
        std::vector<std::size_t> received(groups);
        for (std::size_t k = 0; k < groups; ++k) {
          const Places to = neighbours(topology, groups, k, turn);
          ASSERT_EQ(to.size(), degree(topology, groups));
          EXPECT_EQ(std::set<std::size_t>(to.begin(), to.end()).size(), to.size());
          for (const std::size_t j : to) ++received[j];
        }
        for (const std::size_t count : received) ASSERT_EQ(count, degree(topology, groups)) << groups;
      }
}

}  // namespace
}  // namespace mote

#include "mote/base/tile_draws.hpp"

#include <gtest/gtest.h>

#include "mote/base/normals.hpp"

namespace mote {
namespace {

// claim    numbers drawn side by side are those drawn one by one, bit for bit
// referee  Draws::for_each
TEST(TileDraws, AreThoseOfParticlesOneByOne) {
  const Draws draws{.seed = 5, .step = 7, .stream = 3};
  const std::vector<bool> normal{true, false, true, true};
  std::vector<std::vector<double>> expected;
  draws.for_each(Purpose::kTest, 0, 2500, [&](std::size_t, auto& draw) {
    auto& numbers = expected.emplace_back();
    for (const bool n : normal) numbers.push_back(n ? draw.normal() : draw.uniform());
  });
  for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 2500}, {1000, 1030}, {1500, 2111}, {7, 7}}) {
    std::size_t at = first;
    for_each_tile(draws, Purpose::kTest, normal, first, last,
                  [&](std::size_t begin, std::size_t end, const double* numbers) {
                    ASSERT_EQ(begin, at);
                    for (; at < end; ++at)
                      for (std::size_t k = 0; k < normal.size(); ++k)
                        ASSERT_EQ(numbers[k * kTile + at - begin], expected[at][k]) << at << " " << k;
                  });
    EXPECT_EQ(at, last);
  }
  std::size_t visited = 0;
  for_each_tile(draws, Purpose::kTest, {}, 40, 70,
                [&](std::size_t begin, std::size_t end, const double*) { visited += end - begin; });
  EXPECT_EQ(visited, 30U);
}

// claim    the same bits at every tail, however far
TEST(NormalsFromBits, AreThoseOfEachWord) {
  std::vector<std::uint64_t> bits{0, 1, ~0ULL, 1ULL << 63U, (1ULL << 63U) - 1};
  for (unsigned k = 1; k < 64; ++k)
    for (const std::uint64_t more : {0ULL, 1ULL, 0x123456789ULL})
      bits.push_back((1ULL << k) + more), bits.push_back(~bits.back());
  for (std::uint64_t k = 0; k < 20000; ++k) bits.push_back(mixed(k));
  std::vector<double> normals(bits.size());
  normals_from_bits(bits, normals);
  for (std::size_t i = 0; i < bits.size(); ++i) EXPECT_EQ(normals[i], normal_from_bits(bits[i])) << bits[i];
}

}  // namespace
}  // namespace mote

#pragma once
/// The addressed draws of neighbouring particles, side by side: the bits that their Draw<double> gives one by one.

#include <algorithm>
#include <vector>

#include "mote/base/draws.hpp"

namespace mote {

/// Particles that are drawn, and may be computed, side by side.
inline constexpr std::size_t kTile = 64;

/// The numbers of a block's tiles, one tile after the other.
class TileDraws {
 public:
  /// `normal` says of each number that a particle takes whether it is a normal one; else it is uniform.
  TileDraws(const Address& address, const std::vector<bool>& normal);

  /// The numbers of the next tile: number k of its particle i at [k kTile + i]. They last until the next call.
  const double* next();

 private:
  /// A word of each of the block's eight generators.
  using Lanes [[gnu::vector_size(64)]] = std::uint64_t;

  const std::vector<bool>& normal_;
  Lanes s_[4];  // NOLINT(modernize-avoid-c-arrays): std::array of such a vector loses its attributes
  std::vector<std::uint64_t> words_;
  std::vector<double> numbers_;
};

/// Calls visit(first, last, numbers) for the particles [first, last) of each tile of a stretch: number k of particle i
/// at numbers[k kTile + i - first].
///
/// cost    per number some 5 ns (normal) or 1 ns (uniform); the stretch's blocks are drawn from their beginning
template <class Visit>
void for_each_tile(const Draws& draws, Purpose purpose, const std::vector<bool>& normal, std::size_t first,
                   std::size_t last, Visit&& visit) {
  for (std::size_t block = first / kBlock; block * kBlock < last; ++block) {
    TileDraws tiles({draws.seed, draws.step, purpose, static_cast<std::uint32_t>(block), draws.stream}, normal);
    for (std::size_t tile = block * kBlock; tile < std::min(last, (block + 1) * kBlock); tile += kTile) {
      const double* numbers = tiles.next();
      const std::size_t begin = std::max(first, tile);
      const std::size_t end = std::min(last, tile + kTile);
      if (begin < end) visit(begin, end, numbers + (begin - tile));
    }
  }
}

}  // namespace mote

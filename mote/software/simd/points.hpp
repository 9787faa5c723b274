#pragma once
/// Scrambled Sobol' points as the draws of particles, a vector of them at a time.

#include <bit>
#include <vector>

#include "mote/filter/sobol.hpp"
#include "mote/lanes/ready_draws.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// The points of a step, particle i's the i-th: the bits of PointDraw<R>, normal numbers but for the table's error.
///
/// From one vector of points to the next the digits change by the direction numbers of the lowest zero of its count and
/// of all ones below: one exclusive or a vector.
///
/// cost    a coordinate: two operations a vector, and the draw's own
template <class R>
class VectorPoints {
 public:
  using Source = lanes::VectorDraw<R>;

  /// Starts a step.
  void scramble(const Sobol& sobol, std::size_t points, const Draws& draws) {
    points_.scramble(sobol, points, draws);
    coordinates_.resize(points_.dimensions());
    for (std::size_t k = 0; k < coordinates_.size(); ++k) {
      Coordinate& c = coordinates_[k];
      for (std::size_t lane = 0; lane < kLanes; ++lane) c.lanes[lane] = leading(points_.bits(lane % points, k));
      // a point behind the last, in its vector, may be any
      Bits change = 0;
      for (std::size_t b = 0; b < kCounts; ++b) {
        if (kLanes << b < points) change ^= digits(kLanes << b, k);
        c.changes[b] = change;
      }
    }
  }

  std::size_t dimensions() const { return points_.dimensions(); }

  /// Makes the draws of `count` particles from `first` on, as lanes::ReadyDraw reads them from offset 0 on.
  ///
  /// shape   first: whole vectors; the pattern's draws at most dimensions()
  [[gnu::flatten, gnu::noinline]] void make_ready(const Source& source, const lanes::DrawPattern& pattern,
                                                  std::size_t first, std::size_t count, R* numbers) const {
    for (std::size_t k = 0; k < pattern.normal.size(); ++k) {
      R* const to = numbers + k * kBlock;
      if (pattern.normal[k])
        each(coordinates_[k], k, first, count, to, [&](const auto& bits) { return source.normal_of(bits); });
      else
        each(coordinates_[k], k, first, count, to, [&](const auto& bits) { return Source::uniform_of(bits); });
    }
  }

 private:
  using Bits = typename Source::Bits;
  static constexpr std::size_t kLanes = lanes::kWidth<R>;
  static constexpr std::size_t kCounts = 28;

  struct Coordinate {
    std::array<Bits, kLanes> lanes;     // of the first points
    std::array<Bits, kCounts> changes;  // from a vector whose count ends in so many ones to the next
  };

  static constexpr Bits leading(std::uint64_t digits) { return static_cast<Bits>(digits >> (64 - 8 * sizeof(Bits))); }
  /// The digits of a point without the shift.
  Bits digits(std::size_t point, std::size_t k) const { return leading(points_.bits(point, k) ^ points_.bits(0, k)); }

  template <class OneDraw>
  MOTE_INLINE void each(const Coordinate& c, std::size_t k, std::size_t first, std::size_t count, R* to,
                        const OneDraw& one) const {
    const auto lanes = lanes::Registers<Bits>::load(c.lanes.data());
    Bits base = digits(first, k);
    std::size_t vectors = first / kLanes;
    for (std::size_t j = 0; j < count; j += kLanes) {
      const auto bits = lanes::Registers<Bits>::map([](auto a, auto b) { return lanes::hn::Xor(a, b); }, lanes,
                                                    lanes::Registers<Bits>::all(base));
      one(bits).store(to + j);
      base ^= c.changes[static_cast<std::size_t>(std::countr_one(vectors++))];
    }
  }

  ScrambledPoints points_{Sobol(0), 1, {}};
  std::vector<Coordinate> coordinates_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

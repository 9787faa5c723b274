#pragma once
/// Quasi-random points: Sobol' sequences, and the random scrambling that makes each point uniform and keeps their
/// evenness.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "mote/base/draws.hpp"

namespace mote {

/// The Sobol' sequence.
///
///   digits of coordinate d of point i = XOR over the bits b of i of direction number v_{d,b}
///
/// Every aligned run of 2^k points has exactly one point in each of the 2^k equal intervals of each coordinate.
///
/// shape   dimensions() coordinates of 32 binary digits; 2^32 points
/// cost    construction: 32 words a dimension; a coordinate: one XOR for each bit set in i
/// source  Sobol' 1967; direction numbers new-joe-kuo-6 of Joe & Kuo 2008, as Boost.Random's default_sobol_table has
///         them
class Sobol {
 public:
  static constexpr std::size_t kMostDimensions = 3667;

  /// error   std::invalid_argument for more than kMostDimensions
  explicit Sobol(std::size_t dimensions);

  std::size_t dimensions() const { return directions_.size(); }
  /// The digits of a coordinate, the most significant bit first.
  std::uint32_t digits(std::uint32_t point, std::size_t dimension) const {
    const auto& direction = directions_[dimension];
    std::uint32_t sum = 0;
    for (; point != 0; point &= point - 1) sum ^= direction[static_cast<std::size_t>(std::countr_zero(point))];
    return sum;
  }

 private:
  std::vector<std::array<std::uint32_t, 32>> directions_;
};

/// The first N points of a Sobol' sequence under Owen's nested uniform scrambling: each digit is flipped or not by a
/// coin that belongs to the digits before it, so every point is uniform and any two keep their common leading digits.
///
/// The coins of a tree of six digits are the bits of one hashed word; the digits beyond those that tell N points apart
/// are random. Everything follows from the seed, step and stream of the draws.
///
/// shape   N <= 2^30; a coordinate is 64 digits of a number in [0, 1)
/// cost    a coordinate: log2(N) / 6 + 1 hashes
/// source  Owen 1995; by hashing as Laine & Karras 2011 and Burley 2020, but with an independent coin for each node
class ScrambledPoints {
 public:
  ScrambledPoints(const Sobol& sobol, std::size_t points, const Draws& draws);

  std::uint64_t bits(std::size_t point, std::size_t dimension) const;

 private:
  const Sobol* sobol_;
  unsigned trees_;  // of six digits each
  std::vector<std::uint64_t> keys_;
};

/// One point as the draws of a particle: its coordinates in order.
template <class R>
class PointDraw {
 public:
  PointDraw(const ScrambledPoints& points, std::size_t point) : points_(&points), point_(point) {}

  /// The standard normal quantile of the next coordinate, up to a reflection of its digits.
  R normal() { return static_cast<R>(normal_from_bits(bits())); }
  /// The next coordinate, in the open interval (0, 1).
  R uniform() {
    if constexpr (std::is_same_v<R, float>) {
      return uniform_from_bits(static_cast<std::uint32_t>(bits() >> 32U));
    } else {
      return uniform_from_bits(bits());
    }
  }

 private:
  std::uint64_t bits() { return points_->bits(point_, next_++); }

  const ScrambledPoints* points_;
  std::size_t point_;
  std::size_t next_ = 0;
};

}  // namespace mote

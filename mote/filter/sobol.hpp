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

/// The first N points of a Sobol' sequence under Matousek's random linear scrambling and a random shift: every point is
/// uniform, and any two keep their common leading digits.
///
///   scrambled digits = L digits + shift,  mod 2;   L lower triangular, ones on the diagonal, fair coins below;
///   shift fair coins.  L is applied to the direction numbers, once a step
///
/// Means over the points have the variance that Owen's nested scrambling gives them. Everything follows from the seed,
/// step and stream of the draws.
///
/// shape   N <= 2^30; a coordinate is 64 digits of a number in [0, 1)
/// cost    a step: some 60 words a coordinate for N = 1000; a coordinate of a point: one XOR for each bit set in it
/// source  Matousek 1998; Owen 2003, "Variance with alternative scramblings of digital nets"
class ScrambledPoints {
 public:
  ScrambledPoints(const Sobol& sobol, std::size_t points, const Draws& draws) { scramble(sobol, points, draws); }

  /// Becomes those of other draws.
  void scramble(const Sobol& sobol, std::size_t points, const Draws& draws);

  std::size_t dimensions() const { return digits_.size(); }
  /// The digits of a coordinate, the most significant bit first.
  std::uint64_t bits(std::size_t point, std::size_t dimension) const {
    const Digits& digits = digits_[dimension];
    std::uint64_t sum = digits.shift;
    for (; point != 0; point &= point - 1) sum ^= digits.direction[static_cast<std::size_t>(std::countr_zero(point))];
    return sum;
  }

 private:
  struct Digits {
    std::uint64_t shift;
    std::array<std::uint64_t, 30> direction;
  };
  std::vector<Digits> digits_;  // by coordinate
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

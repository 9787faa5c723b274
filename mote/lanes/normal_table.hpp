#pragma once
/// The table by which vectors of random bits become normal numbers.

#include <array>
#include <cstddef>

namespace mote::lanes {

/// Polynomials for |z| = -Phi^-1(p), one for each octave [2^k, 2^(k+1)) of the tail probability p <= 1/2, or more.
///
///   |z| = sum_j c_j(k) s^j,   s = v - 3/2,   p = v 2^k,  1 <= v < 2
///   by half octaves:          s = v - h/2 - 5/4,   h = 0 for v < 3/2, else 1
///   by pieces:                s = v - (i + 1/2)/32 - 1,   i = floor(32 (v - 1))
///
/// shape   float: degree 5, sixteen octaves, entry e mod 16 of the exponent e of p 2^32; error below 5e-6
///         double by half octaves: degree 7, sixteen octaves in two tables of eight, entry 2 (e mod 8) + h of the
///         exponent e of p 2^64; below 2e-9, for processors that look up in sixteen by one instruction double by
///         pieces: degree 3, row 32 (e mod 16) + piece, below 2e-9, for the others: they read row by row
/// source  interpolation of base's quantile (AS 241) at Chebyshev points
struct NormalTable {
  static constexpr std::size_t kDegreeFloat = 5;
  static constexpr std::size_t kDegreeHalves = 7;
  static constexpr std::size_t kDegreeFine = 3;
  static constexpr int kFineBits = 5;                          ///< of a piece's number
  static constexpr double kFineHalf = 1.0 / (2 << kFineBits);  ///< half a piece
  static constexpr int kOctaves = 16;                          ///< below the last, draws are rare and made one by one

  alignas(64) std::array<std::array<float, 16>, kDegreeFloat + 1> narrow;
  alignas(64) std::array<std::array<double, 16>, kDegreeHalves + 1> halves;      ///< p from 2^-9
  alignas(64) std::array<std::array<double, 16>, kDegreeHalves + 1> halves_low;  ///< p from 2^-17 to 2^-9
  alignas(64) std::array<std::array<double, kDegreeFine + 1>, kOctaves << kFineBits> fine;
};

/// The table, built at its first use.
const NormalTable& normal_table();

}  // namespace mote::lanes

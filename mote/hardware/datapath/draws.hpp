#pragma once
/// What a word of random bits is cut into: one draw of a move, and one of the prior, which is needed at t = 1 only.

#include <cstdint>

#include "mote/hardware/sketch.hpp"

namespace mote::hardware {

/// The draw of a move takes a word's upper bits: normal numbers of up to 4.4 standard deviations.
inline constexpr int kMoveBits = 18;
/// The draw of x_0 takes its lower bits: up to 3.9 standard deviations.
inline constexpr int kPriorBits = 14;

/// The normal number of a word: a sum of numbers from small tables, each chosen by bits of its own.
///
///   z = sum_j a_j[m_j],   a_j[k] = c_j (q + b_j q^3),   q = Phi^-1((k + 1/2) / 2^n_j)
///
/// n = 6, 6, 6 bits of variances 3/12, 4/12, 5/12 for a move; n = 7, 7 of 2/5, 3/5 for the prior. c_j and b_j give each
/// table its variance and the kurtosis 3, so that z has the first five moments of a normal number; the variances differ
/// so that sums do not fall together.
///
/// error   of the distribution function: below 0.0010 (move), 0.0015 (prior)
/// source  sums of few numbers: Malik & Hemani 2016, ACM Computing Surveys 49 (3); the bend: Cornish & Fisher 1938
double normal_draw(std::uint32_t word, bool prior);
/// The uniform number of a word, in [0, 1).
double uniform_draw(std::uint32_t word, bool prior);

/// Draws from a sketch's words (kSignedBits).
class WordDraws {
 public:
  explicit WordDraws(Sketch& sketch) : sketch_(sketch) {}

  /// scale times the normal number, to a step of y.
  Signal normal(const Signal& word, bool prior, double scale, const Format& y) const;
  /// The uniform number, rounded to nearest.
  Signal uniform(const Signal& word, bool prior, const Format& y) const;

 private:
  Sketch& sketch_;
};

}  // namespace mote::hardware

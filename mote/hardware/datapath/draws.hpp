#pragma once
/// What a word of random bits is cut into: one draw of a move, and one of the prior, which is needed at t = 1 only.

#include <cstdint>

#include "mote/hardware/sketch.hpp"

namespace mote::hardware {

/// The draw of a move takes a word's upper bits: normal numbers of up to 4.6 standard deviations.
inline constexpr int kMoveBits = 18;
/// The draw of x_0 takes its lower bits: up to 4.0 standard deviations.
inline constexpr int kPriorBits = 14;

/// The normal number of a word.
///
///   z = +- -Phi^-1((m + 1/2) / 2^bits), the sign from the top bit, m from the others (complemented where it is set)
double normal_draw(std::uint32_t word, bool prior);
/// The uniform number of a word, in [0, 1).
double uniform_draw(std::uint32_t word, bool prior);

/// Draws from a sketch's words (kSignedBits).
class WordDraws {
 public:
  WordDraws(Sketch& sketch, Multiplier multiplier) : sketch_(sketch), multiplier_(multiplier) {}

  /// scale times the normal number, to a step of y.
  Signal normal(const Signal& word, bool prior, double scale, const Format& y) const;
  /// The uniform number, rounded to nearest.
  Signal uniform(const Signal& word, bool prior, const Format& y) const;

 private:
  Sketch& sketch_;
  Multiplier multiplier_;
};

}  // namespace mote::hardware

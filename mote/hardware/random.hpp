#pragma once
/// Random numbers made of uniform bits by tables: normal numbers. Logarithms of uniform ones are in
/// filters/weights.hpp (log_drop), octaves as the chains compare them.

#include "mote/hardware/compound.hpp"
#include "mote/hardware/piecewise.hpp"

namespace mote::hardware {

/// A 32-bit word from mote_words as the units below take it.
inline constexpr Format kSignedBits{true, 0, 31};
inline constexpr Format kPlainBits{false, 0, 32};

/// A 32-bit word that was random bits, as a signed one.
constexpr Word signed_bits(std::uint32_t bits) { return static_cast<std::int32_t>(bits); }

/// Standard normal numbers by inversion of the distribution function:
///
///   z = +- -Phi^-1((m + 1/2) / 2^32), the sign from the word's top bit, m from its other bits (complemented where it
///   is set)
///
/// shape   x: kSignedBits; z: s3.fraction, |z| <= 6.3
/// error   at most a step of z
/// source  base/normal.hpp for the quantile
Piecewise normal_unit(int fraction, Multiplier multiplier = Multiplier::kDsp);

/// What a normal unit stands for at the value of x in kSignedBits, x >= 0.
double normal_of(double x);

/// Two independent standard normal numbers from two words, by the method of Box and Muller with CORDIC:
///
///   (z_0, z_1) = r (cos 2 pi v, sin 2 pi v),   r = sqrt(-2 log u)
///
/// r is one table whose segments shrink towards u = 0 and u = 1: u = (m + 1/2) / 2^32 or, where the first word is
/// negative, 1 - |m| / 2^32. shape   inputs: kSignedBits (for u), kPlainBits (for v, counted from an eighth of a turn
/// below 0); outputs z0_o, z1_o: s3.fraction, |z| <= 6.8 error   below a step of z source  Box & Muller 1958
Compound box_muller(int fraction, Multiplier multiplier = Multiplier::kDsp);

/// r of the value of the first word.
double radius_of(double x);

}  // namespace mote::hardware

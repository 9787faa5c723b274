#pragma once
/// The standard normal quantile and the map from random bits to normal draws.

#include <cstdint>

namespace mote {

/// Standard normal quantile of a lower-tail probability.
///
///   z such that Phi(z) = p
///
/// shape   0 < p < 1; accurate for small p (tails to p = 1e-300)
/// error   none; p outside (0, 1) gives NaN or an infinity
/// cost    one rational function in the centre (85 %), plus a log and a root in the tails
/// source  Wichura 1988, algorithm AS 241 (PPND16): relative error about 1e-16
double standard_normal_quantile(double p);

/// A normal draw from 64 random bits: sign and a 63-bit tail probability, so tails are exact beyond 9 sigma.
///
///   z = +- Phi^-1((m + 1/2) / 2^64),   m = low 63 bits, sign = top bit
double normal_from_bits(std::uint64_t bits);

/// A normal draw from 32 random bits; where the tail probability has few bits left, `more` refines it.
///
///   z = +- Phi^-1((m + v) / 2^32),   m = low 31 bits; v = 1/2, or uniform from `more` when m < 2^15 (|z| > 4.3)
float normal_from_bits(std::uint32_t bits, std::uint64_t more);

/// A uniform draw in the open interval (0, 1) on 2^52 equidistant points, symmetric about 1/2.
inline double uniform_from_bits(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

/// A uniform draw in the open interval (0, 1) on 2^23 equidistant points, symmetric about 1/2.
inline float uniform_from_bits(std::uint32_t bits) { return (static_cast<float>(bits >> 9) + 0.5F) * 0x1p-23F; }

/// A uniform index in {0, ..., n-1} from 64 random bits; its bias is below n / 2^64.
inline std::uint64_t index_from_bits(std::uint64_t bits, std::uint64_t n) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>((static_cast<Wide>(bits) * n) >> 64U);
}

/// The same from 32 bits, n at most 2^28. Probabilities differ from 1/n by up to n / 2^32 of it, in a pattern that has
/// nothing to do with what is indexed: the error of a mean over n draws grows by less than a sixteenth.
inline std::uint32_t index_from_bits(std::uint32_t bits, std::uint32_t n) {
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits) * n) >> 32U);
}

}  // namespace mote

#pragma once
/// Random bits in hardware: the golden twin of mote_uniform.

#include <array>
#include <cstdint>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// LFSR113, a combined Tausworthe generator: 32 bits a word, period about 2^113.
///
/// source  L'Ecuyer 1999, "Tables of maximally equidistributed combined LFSR generators"
struct Tausworthe {
  std::array<std::uint32_t, 4> z;

  std::uint32_t next() {
    z[0] = ((z[0] & 0xFFFFFFFEU) << 18U) ^ (((z[0] << 6U) ^ z[0]) >> 13U);
    z[1] = ((z[1] & 0xFFFFFFF8U) << 2U) ^ (((z[1] << 2U) ^ z[1]) >> 27U);
    z[2] = ((z[2] & 0xFFFFFFF0U) << 7U) ^ (((z[2] << 13U) ^ z[2]) >> 21U);
    z[3] = ((z[3] & 0xFFFFFF80U) << 13U) ^ (((z[3] << 3U) ^ z[3]) >> 12U);
    return z[0] ^ z[1] ^ z[2] ^ z[3];
  }
};

/// The generator of one stream: its registers are keyed by (seed, stream), so that streams begin far apart.
///
/// error   two of n streams overlap within 2^40 words with probability below n^2 2^-72
Tausworthe seeded_tausworthe(std::uint64_t seed, std::uint32_t stream);

/// A generator that moves on where its input column is 1, from its seed on.
struct UniformSource {
  Tausworthe beginning;

  void compute(Columns in, Results out) const {
    Tausworthe generator = beginning;
    Word word = 0;
    each(in[0], out[0], [&](Word enable) { return enable != 0 ? word = generator.next() : word; });
  }
  Circuit circuit() const;
};

}  // namespace mote::hardware

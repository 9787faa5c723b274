#pragma once
/// Traffic: what a distributed filter would send if each of its groups were a processor.

#include <bit>
#include <cstddef>

namespace mote {

/// Messages between groups and the bytes in them, without headers.
struct Traffic {
  double messages = 0;
  double bytes = 0;

  Traffic& operator+=(const Traffic& other) {
    messages += other.messages;
    bytes += other.bytes;
    return *this;
  }
};

/// Every group learns `bytes` of every other.
///
///   messages  K ceil(log2 K);   bytes  K (K - 1) bytes
///
/// source  Bruck, Ho, Kipnis, Upfal & Weathersby 1997: as few messages as can be, each number once to each group
inline Traffic all_gathered(std::size_t groups, double bytes) {
  const auto k = static_cast<double>(groups);
  return {k * static_cast<double>(std::bit_width(groups - 1)), k * (k - 1) * bytes};
}

}  // namespace mote

#include "mote/base/draws.hpp"

#include <Random123/philox.h>

namespace mote {
namespace {

std::uint64_t joined(std::uint32_t low, std::uint32_t high) { return (static_cast<std::uint64_t>(high) << 32U) | low; }

}  // namespace

Xoshiro keyed_generator(const Address& address, std::uint32_t lane) {
  constexpr auto kHigh = 32U;
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(address.seed), static_cast<std::uint32_t>(address.seed >> kHigh)}};
  Xoshiro generator{};
  for (std::uint32_t half = 0; half < 2; ++half) {
    const r123::Philox4x32::ctr_type counter = {{address.block, address.step,
                                                 static_cast<std::uint32_t>(address.purpose) + (address.stream << 8U),
                                                 lane + 8 * half}};
    const auto words = r123::Philox4x32()(counter, key);
    generator.s[2 * half] = joined(words[0], words[1]);
    generator.s[2 * half + 1] = joined(words[2], words[3]);
  }
  return generator;
}

std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31U);
}

}  // namespace mote

#include "mote/hardware/uniform.hpp"

#include "mote/base/draws.hpp"

namespace mote::hardware {

Tausworthe seeded_tausworthe(std::uint64_t seed, std::uint32_t stream) {
  Xoshiro bits = keyed_generator({seed, 0, Purpose::kMove, 0, stream}, 0);
  constexpr std::uint32_t kLeast[] = {2, 8, 16, 128};  // below these a register would be all zeros
  Tausworthe generator{};
  for (std::size_t k = 0; k < generator.z.size(); ++k) {
    generator.z[k] = static_cast<std::uint32_t>(bits.next() >> 32U);
    if (generator.z[k] < kLeast[k]) generator.z[k] += kLeast[k];
  }
  return generator;
}

Circuit UniformSource::circuit() const {
  std::string seed;
  for (const std::uint32_t z : beginning.z) seed = "32'd" + std::to_string(z) + (seed.empty() ? "" : ", ") + seed;
  return {"mote_uniform", {{"Seed", "{" + seed + "}"}}, {{"en_i", 1, false}}, {{"u_o", 32, false}}, 1, true};
}

}  // namespace mote::hardware

#include "mote/base/tile_draws.hpp"

#include <cstring>

#include "mote/base/normals.hpp"

namespace mote {

TileDraws::TileDraws(const Address& address, const std::vector<bool>& normal)
    : normal_(normal), words_(normal.size() * kTile), numbers_(std::max<std::size_t>(1, normal.size()) * kTile) {
  for (std::uint32_t lane = 0; lane < 8; ++lane) {
    const Xoshiro generator = keyed_generator(address, lane);
    for (std::size_t k = 0; k < generator.s.size(); ++k) s_[k][lane] = generator.s[k];
  }
}

const double* TileDraws::next() {
  Lanes a = s_[0], b = s_[1], c = s_[2], d = s_[3];  // Xoshiro::next, eight of them
  for (std::size_t eight = 0; eight < kTile; eight += 8)
    for (std::size_t k = 0; k < normal_.size(); ++k) {
      const Lanes sum = a + d;
      const Lanes word = (sum << 23 | sum >> 41) + a;
      std::memcpy(words_.data() + k * kTile + eight, &word, sizeof(word));
      const Lanes t = b << 17;
      c ^= a;
      d ^= b;
      b ^= c;
      a ^= d;
      c ^= t;
      d = d << 45 | d >> 19;
    }
  s_[0] = a, s_[1] = b, s_[2] = c, s_[3] = d;
  for (std::size_t k = 0; k < normal_.size();) {
    const std::size_t first = k;
    while (k < normal_.size() && normal_[k] == normal_[first]) ++k;
    const std::span words(words_.data() + first * kTile, (k - first) * kTile);
    const std::span numbers(numbers_.data() + first * kTile, words.size());
    if (normal_[first])
      normals_from_bits(words, numbers);
    else
      for (std::size_t i = 0; i < words.size(); ++i) numbers[i] = uniform_from_bits(words[i]);
  }
  return numbers_.data();
}

}  // namespace mote

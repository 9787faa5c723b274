#pragma once
/// Uniform words, the golden twin of rtl/filters/mote_words.sv.

#include <cstdint>
#include <span>

namespace mote::hardware {

/// L'Ecuyer's combined Tausworthe generator taus88, its components mixed from (seed, stream).
///
/// cost    a dozen instructions a word; period about 2^88
/// source  L'Ecuyer 1996; Steele, Lea & Flood 2014 (the mixing)
class Words {
 public:
  Words(std::uint64_t seed, unsigned stream)
      : a_(mixed(seed, stream, 1) | 2), b_(mixed(seed, stream, 2) | 8), c_(mixed(seed, stream, 3) | 16) {}

  std::uint32_t next() {
    const std::uint32_t word = a_ ^ b_ ^ c_;
    a_ = ((a_ & 0xFFFFFFFEU) << 12) ^ (((a_ << 13) ^ a_) >> 19);
    b_ = ((b_ & 0xFFFFFFF8U) << 4) ^ (((b_ << 2) ^ b_) >> 25);
    c_ = ((c_ & 0xFFFFFFF0U) << 17) ^ (((c_ << 3) ^ c_) >> 11);
    return word;
  }
  void fill(std::span<std::uint32_t> words) {
    for (std::uint32_t& word : words) word = next();
  }

 private:
  static std::uint32_t mixed(std::uint64_t seed, unsigned stream, unsigned number) {
    std::uint64_t z = seed + (std::uint64_t{stream} * 3 + number) * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32);
  }

  std::uint32_t a_, b_, c_;
};

}  // namespace mote::hardware

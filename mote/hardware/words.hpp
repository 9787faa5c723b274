#pragma once
/// Uniform words, the golden twin of rtl/mote_words.sv: every random number of a circuit is made of them.

#include <cstdint>
#include <span>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// L'Ecuyer's combined Tausworthe generator taus88, its components mixed from (seed, stream).
///
/// cost    a dozen instructions a word; period about 2^88
/// source  L'Ecuyer 1996; Steele, Lea & Flood 2014 (the mixing)
class Words {
 public:
  Words(std::uint64_t seed, unsigned stream)
      : Words(mixed(seed, stream, 1) | 2, mixed(seed, stream, 2) | 8, mixed(seed, stream, 3) | 16) {}
  /// From components as they are; none may be below 2, 8 and 16.
  constexpr Words(std::uint32_t a, std::uint32_t b, std::uint32_t c) : a_(a), b_(b), c_(c) {}

  std::uint32_t word() const { return a_ ^ b_ ^ c_; }
  void advance() {
    a_ = ((a_ & 0xFFFFFFFEU) << 12) ^ (((a_ << 13) ^ a_) >> 19);
    b_ = ((b_ & 0xFFFFFFF8U) << 4) ^ (((b_ << 2) ^ b_) >> 25);
    c_ = ((c_ & 0xFFFFFFF0U) << 17) ^ (((c_ << 3) ^ c_) >> 11);
  }
  std::uint32_t next() {
    const std::uint32_t present = word();
    advance();
    return present;
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

/// The words of a stream as an operator: a column of advances goes in, the words after them come out.
struct WordSource {
  std::uint64_t seed = 1;
  std::uint32_t stream = 0;

  void compute(Columns in, Results out) const {
    Words words(seed, stream);
    each(in[0], out[0], [&](Word advances) {
      if (advances != 0) words.advance();
      return Word{words.word()};
    });
  }
  Circuit circuit() const {
    return {"mote_words",
            {parameter("Seed", 64, seed), parameter("Stream", 32, stream)},
            {{"advance_i", 1, false}},
            {{"word_o", 32, false}},
            1,
            true};
  }
};

}  // namespace mote::hardware

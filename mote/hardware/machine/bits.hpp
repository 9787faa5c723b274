#pragma once
/// Buses as 32-bit words, the lowest first: fields put side by side, and taken again.

#include <cstdint>
#include <vector>

namespace mote::hardware {

/// Words that a bus of so many bits takes.
constexpr std::size_t words_of(int bits) { return static_cast<std::size_t>((bits + 31) / 32); }

/// A bus that fields are appended to, from bit 0 on.
class BitWriter {
 public:
  explicit BitWriter(int bits) : words_(words_of(bits)) {}

  /// shape   width: at most 64; the bus has room
  void append(std::int64_t value, int width) {
    for (int bit = 0; bit < width; ++bit, ++at_)
      words_[at_ / 32] |= static_cast<std::uint32_t>((value >> bit) & 1) << (at_ % 32);
  }
  const std::vector<std::uint32_t>& words() const { return words_; }

 private:
  std::vector<std::uint32_t> words_;
  std::size_t at_ = 0;
};

/// A bus that fields are taken from, from bit 0 on.
class BitReader {
 public:
  explicit BitReader(const std::uint32_t* words) : words_(words) {}

  /// shape   width: from 1 to 64
  std::uint64_t take(int width) {
    std::uint64_t value = 0;
    for (int bit = 0; bit < width;) {
      const auto in_word = static_cast<int>(at_ % 32);
      const int taken = width - bit < 32 - in_word ? width - bit : 32 - in_word;
      const std::uint64_t part = (words_[at_ / 32] >> in_word) & ((std::uint64_t{1} << taken) - 1);
      value |= part << bit;
      bit += taken;
      at_ += static_cast<std::size_t>(taken);
    }
    return value;
  }
  std::int64_t take_signed(int width) { return static_cast<std::int64_t>(take(width) << (64 - width)) >> (64 - width); }

 private:
  const std::uint32_t* words_;
  std::size_t at_ = 0;
};

}  // namespace mote::hardware

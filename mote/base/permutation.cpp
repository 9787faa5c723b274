#include "mote/base/permutation.hpp"

#include "mote/base/draws.hpp"

namespace mote {

Permutation::Permutation(std::size_t n, std::uint64_t key) : n_(n), key_(key), half_bits_(1) {
  while ((1ULL << (2 * half_bits_)) < n_) ++half_bits_;
}

std::size_t Permutation::operator()(std::size_t j) const {
  std::uint64_t value = j;
  do {
    value = scrambled(value);
  } while (value >= n_);
  return static_cast<std::size_t>(value);
}

std::uint64_t Permutation::scrambled(std::uint64_t value) const {
  const std::uint64_t mask = (1ULL << half_bits_) - 1;
  std::uint64_t left = value >> half_bits_;
  std::uint64_t right = value & mask;
  for (std::uint64_t round = 0; round < 6; ++round) {
    const std::uint64_t next = left ^ (mixed(key_ + (round << 56U) + right) & mask);
    left = right;
    right = next;
  }
  return (left << half_bits_) | right;
}

}  // namespace mote

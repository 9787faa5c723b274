#pragma once
/// A pseudo-random permutation by address: element j of it costs O(1) and no memory.

#include <cstddef>
#include <cstdint>

namespace mote {

/// A permutation of {0, ..., n-1} fixed by a key: j maps to a place, each place once.
///
///   a balanced Feistel network of six rounds on 2h bits, 4^h >= n, walked until it lands below n
///
/// shape   n >= 1
/// cost    at most four walks in the mean, six mixes each
/// source  Black & Rogaway 2002 (cycle walking); the round function is the finalizer of splitmix64
class Permutation {
 public:
  Permutation(std::size_t n, std::uint64_t key);

  std::size_t operator()(std::size_t j) const;

 private:
  std::uint64_t scrambled(std::uint64_t value) const;

  std::uint64_t n_;
  std::uint64_t key_;
  unsigned half_bits_;
};

}  // namespace mote

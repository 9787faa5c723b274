#pragma once
/// Randomness by address: every draw is a function of (seed, step, purpose, stream, particle block, draw number), never
/// of call order.
///
/// Particles are drawn in blocks of 1024. A block has eight generators (xoshiro256++), keyed by a counter-based
/// generator (Philox4x32-10) from its address. Particle i of a block uses generator i mod 8; the draws of a generator
/// go to its particles in order, so one vector of eight generators serves eight particles at a time and the scalar code
/// below gives the same numbers. In float, a word serves two particles: its low half particle j, its high half particle
/// j + 8 of each sixteen. See docs/decisions/0001-random-numbers.md.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "mote/base/normal.hpp"

namespace mote {

/// Particles that share one keyed block of random numbers.
inline constexpr std::size_t kBlock = 1024;

/// What a stream of draws is for; streams of different purposes are independent.
enum class Purpose : std::uint32_t {
  kPrior,
  kMove,
  kParent,
  kSelect,
  kAccept,
  kStart,
  kObserve,
  kReset,
  kTest,
  kTruth,
  kBootstrap,
  kPoints
};

/// Where a block of draws lives.
struct Address {
  std::uint64_t seed;
  std::uint32_t step;
  Purpose purpose;
  std::uint32_t block;
  std::uint32_t stream = 0;  ///< below 2^24: which of several users of one purpose (groups of a distributed filter)
};

/// One xoshiro256++ generator (Blackman & Vigna 2021): period 2^256 - 1, 64 bits a word.
struct Xoshiro {
  std::array<std::uint64_t, 4> s;

  std::uint64_t next() {
    const std::uint64_t word = std::rotl(s[0] + s[3], 23) + s[0];
    const std::uint64_t t = s[1] << 17U;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = std::rotl(s[3], 45);
    return word;
  }
};

/// The generator of one lane (0..7) of the block at an address: Philox4x32-10 of (block, step, purpose, lane) under the
/// seed.
Xoshiro keyed_generator(const Address& address, std::uint32_t lane);

/// 64 well-mixed bits from 64 bits (the finalizer of splitmix64).
std::uint64_t mixed(std::uint64_t bits);

/// The draws of one particle: what a model receives as `draw`.
template <class R>
class Draw {
 public:
  Draw(Xoshiro& generator, bool high) : generator_(&generator), high_(high) {}

  /// A standard normal number, tails correct beyond 6 sigma.
  R normal() {
    if constexpr (std::is_same_v<R, float>) {
      const std::uint32_t bits = half();
      return normal_from_bits(bits, mixed(generator_->s[1] + (high_ ? 1 : 0)));
    } else {
      return normal_from_bits(generator_->next());
    }
  }

  /// A uniform number in the open interval (0, 1).
  R uniform() {
    if constexpr (std::is_same_v<R, float>) {
      return uniform_from_bits(half());
    } else {
      return uniform_from_bits(generator_->next());
    }
  }

  /// A uniform index in {0, ..., n-1}.
  std::size_t index(std::size_t n) {
    if constexpr (std::is_same_v<R, float>) {
      return index_from_bits(half(), static_cast<std::uint32_t>(n));
    } else {
      return static_cast<std::size_t>(index_from_bits(generator_->next(), static_cast<std::uint64_t>(n)));
    }
  }

 private:
  std::uint32_t half() {
    const std::uint64_t word = generator_->next();
    return static_cast<std::uint32_t>(high_ ? word >> 32U : word);
  }

  Xoshiro* generator_;
  bool high_;
};

/// The random numbers of one block of 1024 particles, for particles visited in order.
///
/// cost    construction: eight Philox blocks (16 in float); a draw: one xoshiro word
template <class R>
class BlockDraws {
 public:
  static constexpr std::size_t kLanes = std::is_same_v<R, float> ? 16 : 8;

  explicit BlockDraws(const Address& address) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes_[lane] = keyed_generator(address, static_cast<std::uint32_t>(lane % 8));
  }

  /// The draws of the particle at `offset` (0..1023) in the block; offsets are to be visited in increasing order.
  Draw<R> particle(std::size_t offset) { return Draw<R>(lanes_[offset % kLanes], offset % kLanes >= 8); }

 private:
  std::array<Xoshiro, kLanes> lanes_;
};

/// The seed and step that a filter draws under; `block` and `for_each` give the addressed streams.
struct Draws {
  std::uint64_t seed = 1;
  std::uint32_t step = 0;
  std::uint32_t stream = 0;

  template <class R = double>
  BlockDraws<R> block(Purpose purpose, std::size_t index = 0) const {
    return BlockDraws<R>({seed, step, purpose, static_cast<std::uint32_t>(index), stream});
  }

  /// The first uniform number of a purpose: that of particle 0, without keying the other lanes.
  double uniform(Purpose purpose) const {
    return uniform_from_bits(keyed_generator({seed, step, purpose, 0, stream}, 0).next());
  }

  /// Calls visit(i, draw) for each i in [first, last), block by block; `first` is a multiple of the block size.
  template <class R = double, class Visit>
  void for_each(Purpose purpose, std::size_t first, std::size_t last, Visit&& visit) const {
    for (std::size_t start = first; start < last; start += kBlock) {
      auto draws = block<R>(purpose, start / kBlock);
      const std::size_t stop = start + kBlock < last ? start + kBlock : last;
      for (std::size_t i = start; i < stop; ++i) {
        auto draw = draws.particle(i - start);
        visit(i, draw);
      }
    }
  }
};

}  // namespace mote

#pragma once
/// What a simulated filter circuit is asked for, over the border of a library that is loaded.

#include <cstdint>

namespace mote::hardware {

/// Words are of 32 bits, the lowest first; a port of b bits takes (b + 31) / 32 of them.
struct Request {
  const std::uint32_t* registers;     ///< one word a register, in the order of the ports
  const std::uint32_t* observations;  ///< one port's words a step
  std::uint32_t observation_words;
  std::uint32_t steps;
  std::uint32_t observation_pause, estimate_pause;  ///< how often a stream pauses, in 256ths
  std::uint64_t seed;                               ///< of the pauses
  std::uint64_t most_cycles;
  void* self;
  /// Called with what a cycle writes to the particle memory: valid, slots and states, a port's words each.
  void (*kept)(void* self, const std::uint32_t* words);
  /// Called with an estimate that leaves: the port's words.
  void (*estimated)(void* self, const std::uint32_t* words);
  /// Called when the registers' bus gave a wrong word or answer.
  void (*answered_wrong)(void* self);
};

}  // namespace mote::hardware

#pragma once
/// What a filter in hardware asks of a model: two pipelines of integer arithmetic, here as functions of whole columns.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mote::hardware {

/// The particles of a step, a column for each state.
using Particles = std::vector<std::vector<std::int64_t>>;
/// Uniform 32-bit words, a column for each that a particle draws.
using WordColumns = std::vector<std::vector<std::uint32_t>>;
/// A step's observations and inputs, as the circuit's integers.
using Observed = std::span<const std::int64_t>;

/// Cycles of a filter's own product by a tree of adders, with a factor of at most 32 bits: mote_times.
constexpr unsigned kLogicProduct = 5;

/// Widths that the circuits and their golden models share.
struct Formats {
  unsigned dims = 1;
  unsigned value_bits = 18;   ///< of a state
  unsigned draw_words = 1;    ///< that a proposal takes
  unsigned log_bits = 24;     ///< of a log weight: octaves with 10 fraction bits
  unsigned weight_bits = 24;  ///< of a weight at the running scale
  unsigned extra_bits = 8;    ///< fraction bits of a mean beyond those of the state
  unsigned propose_latency = 4, weigh_latency = 4;
  unsigned product_latency = 1;  ///< of the filter's own products: by multipliers, or longer by adders (mote_times)
  unsigned interval = 1;         ///< cycles from a particle of a lane to the next, at least
  unsigned carried = 0;          ///< words beside the state's that a proposal brings to be weighed, of value_bits each
  unsigned count_bits = 10;      ///< At of a circuit that resamples: N <= 2^count_bits, from 6
};

/// A model as the circuit computes it.
///
///   propose(t, observed, parents, words, states): states = p(. | parents) by words; at t = 1 parents come from the
///   prior weigh(t, observed, states, log_weights): log2 p(y | state) in units of 2^-10, saturated to log_bits
///
/// shape   parents: `dims` columns of n; states: `dims` and `carried` of n; words: `draw_words` columns of n;
///         log_weights: n
struct Arithmetic {
  Formats formats;
  std::function<void(unsigned, Observed, const Particles&, const WordColumns&, Particles&)> propose;
  std::function<void(unsigned, Observed, const Particles&, std::span<std::int64_t>)> weigh;
};

}  // namespace mote::hardware

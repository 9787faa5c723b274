#pragma once
/// The independent Metropolis chain over weighted proposals: selection without a sum of weights.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "mote/filter/options.hpp"
#include "mote/filter/particles.hpp"

namespace mote {

/// The proposals of P chains in one array: Q that may be kept, chain by chain, then P N_b for burning in, chain by
/// chain. A chain visits its burn-in proposals first, then its own part of the Q.
struct ChainLayout {
  std::size_t kept;     ///< N, states kept over all chains
  std::size_t draws;    ///< Q >= N
  std::size_t chains;   ///< P <= N
  std::size_t burn_in;  ///< N_b per chain

  std::size_t proposals() const { return draws + chains * burn_in; }
};

/// A stretch of particles or proposals, [first, last).
struct Stretch {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
  bool has(std::size_t i) const { return first <= i && i < last; }
};

/// n cut into parts: part k is [begin(k), begin(k + 1)), and the first n mod parts of them are one longer.
struct Cut {
  std::size_t length, longer;

  Cut(std::size_t n, std::size_t parts) : length(n / parts), longer(n % parts) {}
  std::size_t begin(std::size_t k) const { return k * length + std::min(k, longer); }
  /// The part that i < n belongs to.
  std::size_t part_of(std::size_t i) const {
    const std::size_t in_longer = longer * (length + 1);
    return i < in_longer ? i / (length + 1) : longer + (i - in_longer) / length;
  }
};

/// Counts of a run of chains.
struct ChainReport {
  std::size_t offered = 0, accepted = 0;
};

/// Chains in motion, which write the proposals that make up the unweighted set: picks[j] for j < N.
///
///   accept proposal x^ after x with probability min(w(x^) / w(x), 1):   log u < log w(x^) - log w(x)
///
/// shape   log_weights, log_uniforms: (Q + P N_b,), log_uniforms[j] decides on proposal j; not all weights zero
///         starts: (P,) proposal that each chain starts from, or empty: the first that it visits. A chain passes its
///         own start over, which was drawn by its weight and is no independent proposal: offered again it would bias
///         what is kept.
/// cost    O(Q + P N_b) in all, one comparison a proposal
/// source  docs/filters.md (F13), (F14); IMH-HW (11), (16), (17)
class Chains {
 public:
  Chains(const ChainLayout& layout, std::span<const double> log_weights, std::span<const double> log_uniforms,
         std::span<const Index> starts, std::span<Index> picks);

  /// Has the proposals [first, last) visited by the chains that they belong to. Those of one chain come in its order:
  /// burning in first, then in growing order. Proposals of different chains may be taken side by side.
  void take(std::size_t first, std::size_t last);
  /// Counts so far.
  ChainReport report() const;
  /// What chains [first, last) have come to, where it lies: for those who run some chains and are told of others.
  std::array<std::span<std::byte>, 2> outcome(std::size_t first, std::size_t last);

 private:
  /// One chain: where it is, where it started.
  struct Chain {
    static constexpr std::size_t kNowhere = ~std::size_t{0};
    std::size_t at = kNowhere, start = kNowhere;
    ChainReport report;
  };
  std::size_t visit(Chain& chain, std::size_t proposal) const;

  ChainLayout layout_;
  Cut drawn_, kept_by_;
  std::span<const double> log_weights_, log_uniforms_;
  std::span<Index> picks_;
  std::vector<Chain> chains_;
};

/// Runs chains over all their proposals.
ChainReport run_chains(const ChainLayout& layout, std::span<const double> log_weights,
                       std::span<const double> log_uniforms, std::span<const Index> starts, std::span<Index> picks);

/// N_b after which an independent Metropolis chain is within `distance` of its law in total variation, at most `most`.
///
///   n = log(distance) / log(1 - mean / largest)
///
/// source  docs/filters.md (F18); Mengersen & Tweedie 1996, theorem 2.1: the chain converges like (1 - mean/largest)^n
std::size_t burn_in_for(double mean_weight, double largest_weight, double distance, std::size_t most);

}  // namespace mote

#pragma once
/// What a step knows of its blocks of 1024 particles, and what follows from it for all of them.

#include <array>
#include <cstdint>
#include <vector>

#include "mote/base/archive.hpp"
#include "mote/base/draws.hpp"
#include "mote/engine/team.hpp"
#include "mote/filter/estimate.hpp"

namespace mote {

/// Where the children of each block of particles begin. Child j belongs to the particle whose cumulative share of N
/// contains j + u.
///
///   position(b) = N sum_{i before block b} w_i / sum_i w_i - u,   first(b) = ceil(position(b)),   N children
///
/// shape   (blocks + 1,); blocks without weight have no children. The blocks are those of one process, the children are
///         numbered over all: first.front() = 0 on the first rank, first.back() = N on the last
struct ChildMap {
  std::vector<double> position;
  std::vector<std::uint32_t> first;
  std::vector<double> children_per_weight;  ///< by block: N over the total, in the block's own scale
  std::vector<std::uint32_t> born;          ///< by rank: the first child of its particles; then N

  void keep(Archive& archive) { archive(position, first, children_per_weight, born); }

  /// The block whose particles have child j.
  std::size_t block_of(std::uint32_t child) const;
};

/// Sums over all particles, of every rank. Weights are in units of 2^reference.
struct Totals {
  double reference = 0;  ///< largest shift of a block; -infinity when all weights are zero
  double weight = 0;     ///< sum of weights
  double square = 0;     ///< sum of their squares
  std::size_t particles = 0;
  ExactSum all, mine;  ///< weights of all ranks, and of this one

  bool collapsed() const { return !(weight > 0); }
  double log_sum() const;  ///< log of the sum of weights, nat
  double ess() const;
  /// What a weight of a block counts here.
  double scale_of(double shift) const;
};

/// Sums of one block, its weights in units of 2^shift.
struct WeightSums {
  double shift = 0, weight = 0, square = 0;
};
/// Sums of one component of one block about a centre: of w (x - c) and w (x - c)^2.
struct ComponentSums {
  double centre = 0, first = 0, second = 0;
};

/// The sums of every block of a process, each written by whoever worked on the block. What they make up over all blocks
/// of a team is summed exactly: the same bits for any number of threads and ranks.
///
/// Where ranks share up to kMostTold blocks, each is told the sums of all of them, at once, and works out the rest by
/// itself; of more blocks they add up what they need in turn.
///
/// cost    O(N / 1024) for every total, and with a team one message of all sums or seven reductions of a few numbers;
///         memory (3 + 3 D) 8 bytes a block
class BlockSums {
 public:
  /// Blocks of all ranks whose sums are told: 48 kB of a filter of one state.
  static constexpr std::size_t kMostTold = 1024;
  /// Whether a rank with so many of all particles is told every rank's sums.
  static bool tells(std::size_t particles, std::size_t all) { return particles < all && all <= kMostTold * kBlock; }

  /// For this process's `particles`; `team`, when not null, has `all` in all.
  BlockSums(std::size_t particles, std::size_t dimensions, Team* team = nullptr, std::size_t all = 0);

  std::size_t blocks() const { return weights_.size(); }
  std::size_t particles() const { return particles_; }
  std::size_t dimensions() const { return dimensions_; }
  void set(std::size_t block, const WeightSums& sums) { weights_[block] = sums; }
  void set(std::size_t block, std::size_t d, const ComponentSums& sums) { components_[block * dimensions_ + d] = sums; }
  double shift(std::size_t block) const { return weights_[block].shift; }
  /// The sums of a block are another rank's.
  void leave_out(std::size_t block) { weights_[block] = {-kInfinity, 0, 0}; }
  /// Takes over the scales of the blocks that were left out.
  ///
  /// shape   all ranks have all blocks
  void complete_shifts();

  /// Writes or reads the sums of the weights, which say the blocks' scales.
  void keep(Archive& archive) { archive.fill(std::span(weights_)); }

  Totals totals() const;
  /// Mean and standard deviation of every component; NaN for the latter where no spreads were summed up.
  void moments(const Totals& totals, bool spreads, std::span<Moments> all) const;
  /// Fills the map of so many children for u in (0, 1); with a team after totals() of the same sums.
  void map_children(const Totals& totals, double u, std::size_t children, ChildMap& map) const;

 private:
  void add_up_with_team(std::span<ExactSum> sums) const {
    if (team_ != nullptr) team_->add(sums);
  }
  bool alone_in_one_block() const { return all_ <= kBlock; }
  using Triple = std::array<double, 3>;  // WeightSums or ComponentSums, as numbers
  template <class Term>
  void add_aligned(const Totals& totals, const Term& term) const;
  void tell() const;
  void take_part(const ChildMap& all, ChildMap& map) const;

  std::size_t particles_, dimensions_;
  Team* team_;
  std::size_t all_;
  std::vector<std::size_t> begins_;           // of the ranks' blocks, where they are told
  mutable std::vector<BlockSums> everyones_;  // then one: the sums of all blocks, without a team
  mutable std::vector<Triple> told_;          // the same as numbers
  mutable ChildMap map_of_all_;
  mutable std::vector<double> exponents_, aligned_;  // scratch of moments()
  mutable std::vector<ExactSum> exact_;
  std::vector<WeightSums> weights_;
  std::vector<ComponentSums> components_;
};

}  // namespace mote

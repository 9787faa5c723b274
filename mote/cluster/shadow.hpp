#pragma once
/// Shadow: what the ranks of a team tell each other about a SISR filter's particles, without the particles.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mote/base/draws.hpp"
#include "mote/engine/team.hpp"
#include "mote/software/share.hpp"
#include "mote/software/simd/block_sums.hpp"

namespace mote {

/// The cloud that casts the shadow.
struct ShadowCloud {
  std::size_t particles = 1024;  ///< of all ranks, a block of 1024 a rank at least
  std::size_t dimensions = 1;
  std::size_t angles = 0;        ///< of these components
  std::size_t number_bytes = 8;  ///< of a component
  double variation = 1;          ///< coefficient of variation of the weights: ESS = N / (1 + variation^2)
  std::uint64_t seed = 1;
};

/// A filter's part on one rank of a team, SISR with systematic resampling at every step: the operations of a team that
/// VectorImportanceFilter calls, in its order. What decides how many children change ranks, the weight sum of each
/// rank's n particles, is drawn by its law for many particles:
///
///   W = n (1 + variation z / sqrt(n)),   z ~ N(0, 1) by step and rank
///
/// shape   anywhere: memory of at least parcel_bytes(), which all parcels are sent from and received to; its content is
///         nobody's, so ranks may share it
/// cost    the team's operations and O(R) a step
class Shadow {
 public:
  Shadow(Team& team, const ShadowCloud& cloud, std::span<std::byte> anywhere)
      : team_(&team), cloud_(cloud), home_(cloud.particles, &team), anywhere_(anywhere) {
    for (std::size_t r = 0; r < team.ranks(); ++r) owned_.emplace_back(cloud.particles, team.ranks(), r);
    sum_weights(0);
  }

  /// Bytes of the largest parcel on a team of so many ranks.
  static std::size_t parcel_bytes(const ShadowCloud& cloud, std::size_t ranks) {
    return Share(cloud.particles, ranks, 0).count * cloud.number_bytes;
  }

  /// Particles of this rank.
  std::size_t particles() const { return home_.count; }

  /// One step with its estimates; work() is what a rank does with its own particles.
  template <class Work>
  void step(Step t, const Work& work) {
    if (resampled_) move_children();
    work();
    sum_weights(t);
    if (!told())
      for (int moment = 0; moment < 2; ++moment) {
        std::vector<double> exponents(cloud_.dimensions);
        team_->largest(exponents);
        std::vector<ExactSum> sums(cloud_.dimensions);
        team_->add(sums);
      }
    for (std::size_t angle = 0; angle < cloud_.angles; ++angle) {
      std::array<ExactSum, 2> sums;
      team_->add(sums);
    }
    find_births(t);
    resampled_ = true;
  }

 private:
  bool told() const { return BlockSums::tells(home_.count, home_.all); }

  /// A rank's weight sum over N.
  ExactSum weight_of(std::size_t rank, Step t) const {
    auto block = Draws{cloud_.seed, static_cast<std::uint32_t>(t)}.block(Purpose::kTest, rank);
    const auto n = static_cast<double>(owned_[rank].count);
    const double weight = n * std::max(0.0, 1 + cloud_.variation * block.particle(0).normal() / std::sqrt(n));
    ExactSum sum;
    sum.add(weight / static_cast<double>(home_.all));
    return sum;
  }

  void sum_weights(Step t) {
    if (told()) {
      const std::size_t numbers = 3 * (1 + cloud_.dimensions);  // of a block
      sums_.resize(blocks_of(home_.all) * numbers);
      std::vector<std::size_t> begins = begins_of_shares(home_.all, team_->ranks());
      for (std::size_t& begin : begins) begin = blocks_of(begin) * numbers;
      team_->complete(std::as_writable_bytes(std::span(sums_)), begins);
      return;
    }
    double reference = 0;
    team_->largest({&reference, 1});
    mine_ = weight_of(team_->rank(), t);
    std::array<ExactSum, 2> sums;
    sums[0] = mine_;
    team_->add(sums);
    all_ = sums[0];
  }

  /// The first child of every rank's particles.
  void find_births(Step t) {
    const auto n = static_cast<double>(home_.all);
    const double u = Draws{cloud_.seed, static_cast<std::uint32_t>(t)}.uniform(Purpose::kSelect);
    const auto child_behind = [&](const ExactSum& before) {
      const double position = std::ceil(before.value() / all_.value() * n - u);
      return static_cast<std::uint32_t>(before == all_ ? n : std::clamp(position, 0.0, n));
    };
    if (told()) {
      std::vector<ExactSum> before(team_->ranks() + 1);
      for (std::size_t r = 0; r < team_->ranks(); ++r) {
        before[r + 1] = before[r];
        before[r + 1] += weight_of(r, t);
      }
      all_ = before.back();
      born_.clear();
      for (const ExactSum& sum : before) born_.push_back(child_behind(sum));
      return;
    }
    born_ = team_->gather(child_behind(team_->before(mine_)));
    born_.push_back(static_cast<std::uint32_t>(home_.all));
  }

  /// Sends every other rank the children whose places it owns: a parcel for each component.
  void move_children() {
    const auto bytes = [&](std::size_t parents, std::size_t owner) {
      const auto first = std::max<std::size_t>(born_[parents], owned_[owner].first);
      const auto end = std::min<std::size_t>(born_[parents + 1], owned_[owner].end());
      return first < end ? (end - first) * cloud_.number_bytes : 0;
    };
    std::vector<ParcelOut> out;
    std::vector<ParcelIn> in;
    for (std::size_t r = 0; r < team_->ranks(); ++r) {
      if (r == team_->rank()) continue;
      for (std::size_t d = 0; d < cloud_.dimensions; ++d) {
        if (const std::size_t n = bytes(team_->rank(), r); n > 0) out.push_back({r, anywhere_.first(n)});
        if (const std::size_t n = bytes(r, team_->rank()); n > 0) in.push_back({r, anywhere_.first(n)});
      }
    }
    team_->exchange(out, in);
  }

  Team* team_;
  ShadowCloud cloud_;
  Share home_;
  std::vector<Share> owned_;  // by rank
  std::span<std::byte> anywhere_;
  ExactSum mine_, all_;
  std::vector<std::uint32_t> born_;  // by rank: the first child of its particles; then N
  std::vector<double> sums_;         // of all blocks, where they are told
  bool resampled_ = false;
};

}  // namespace mote

#pragma once
/// ChainShadow: what the ranks of a team tell each other about the Metropolis filters' chains, without the particles.

#include <algorithm>
#include <array>
#include <vector>

#include "mote/engine/team.hpp"
#include "mote/software/share.hpp"

namespace mote {

/// The chains that cast the shadow: IMH or its auxiliary filter, Q = N proposals, nothing burnt in.
struct ChainCloud {
  std::size_t particles = 1024;  ///< of all ranks, a block of 1024 a rank at least
  std::size_t dimensions = 1;
  std::size_t angles = 0;        ///< of these components
  std::size_t number_bytes = 8;  ///< of a component
  std::size_t chains = 16;       ///< of all ranks, one a rank at least
  bool weighted_start = false;   ///< as ChainStart::kWeighted
};

/// A filter's part on one rank of a team: the operations of a team that VectorMetropolisFilter calls, in its order.
///
/// shape   anywhere: memory of at least column_bytes(), which every column is completed in; its content is nobody's, so
///         ranks may share it
/// cost    the team's operations, memory of a column
class ChainShadow {
 public:
  ChainShadow(Team& team, const ChainCloud& cloud, std::span<std::byte> anywhere)
      : team_(&team),
        cloud_(cloud),
        share_({cloud.particles, cloud.particles, cloud.chains, 0}, &team),
        column_(anywhere.first(column_bytes(cloud))) {
    sum_weights();
    complete_set(begins_of_shares(cloud.particles, team.ranks()));
  }

  /// Bytes of a component of all particles.
  static std::size_t column_bytes(const ChainCloud& cloud) { return cloud.particles * cloud.number_bytes; }

  /// Proposals that this rank's chains visit.
  std::size_t visited() const { return end() - first(); }
  /// Proposals that it makes: whole blocks, those at the ends are made by its neighbours, too.
  std::size_t made() const {
    return std::min((end() + kBlock - 1) / kBlock * kBlock, cloud_.particles) - first() / kBlock * kBlock;
  }

  /// One step with its estimates; make() is what a rank does with the proposals that it makes, visit() with those that
  /// its chains visit.
  template <class Make, class Visit>
  void step(const Make& make, const Visit& visit) {
    make();
    sum_weights();
    for (int moment = 0; moment < 2; ++moment) {
      most_of(cloud_.dimensions);
      sum_of(cloud_.dimensions);
    }
    for (std::size_t angle = 0; angle < cloud_.angles; ++angle) sum_of(2);
    if (cloud_.weighted_start) find_starts();
    visit();
    complete_set(share_.begins(cloud_.particles));
    for (int count = 0; count < 2; ++count) team_->gather(0);  // offered, accepted
  }

 private:
  std::size_t begin_of(std::size_t chain) const { return Cut(cloud_.particles, cloud_.chains).begin(chain); }
  std::size_t first() const { return begin_of(share_.first()); }
  std::size_t end() const { return begin_of(share_.end()); }

  void most_of(std::size_t count) {
    std::vector<double> numbers(count);
    team_->largest(numbers);
  }
  void sum_of(std::size_t count) {
    std::vector<ExactSum> sums(count);
    team_->add(sums);
  }
  void sum_weights() {
    most_of(1);
    sum_of(2);
  }
  void complete_set(std::span<const std::size_t> begins) {
    for (std::size_t d = 0; d < cloud_.dimensions; ++d) team_->complete(column_, begins);
  }
  /// All weights with their blocks' scales, and the states that chains start from.
  void find_starts() {
    team_->complete(column_, share_.begins(cloud_.particles));
    team_->complete({}, share_.begins(0));  // of those burnt in
    most_of(blocks_of(cloud_.particles));
    most_of(cloud_.chains * cloud_.dimensions);
  }

  Team* team_;
  ChainCloud cloud_;
  ChainShare share_;
  std::span<std::byte> column_;
};

}  // namespace mote

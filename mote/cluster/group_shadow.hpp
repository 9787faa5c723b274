#pragma once
/// GroupShadow: what the ranks of a team tell each other about a distributed filter's groups, without the particles
/// that stay where they are.

#include <numeric>
#include <vector>

#include "mote/filter/exchange.hpp"
#include "mote/software/team_membership.hpp"

namespace mote {

/// The groups that cast the shadow: local resampling at every step.
struct GroupCloud {
  std::size_t particles = 1024;  ///< of all groups
  std::size_t dimensions = 1;
  GroupOptions groups;  ///< whose exchange_when is 1
};

/// A filter's part on one rank of a team: the operations of a team that ImportanceFilter with a GroupSelector calls, in
/// its order. The particles that groups send each other are there, and travel by the filter's own code (dealt()).
///
/// shape   at most as many ranks as groups
/// cost    the team's operations and O(K) a step; memory of the particles that leave
template <class R>
class GroupShadow {
 public:
  GroupShadow(Team& team, const GroupCloud& cloud)
      : cloud_(cloud), members_(Groups(cloud.particles, cloud.groups.groups), team), travellers_(0, 0) {
    if (!cloud.groups.exchanges()) return;
    for (std::size_t k = members_.begin(); k < members_.end(); ++k) {
      sent_.emplace_back(leaving());
      std::iota(sent_.back().begin(), sent_.back().end(), static_cast<Index>((k - members_.begin()) * leaving()));
    }
    travellers_ = Particles<R>(cloud.dimensions, leaving() * sent_.size());
    log_weights_.resize(travellers_.size());
  }

  /// Particles of this rank.
  std::size_t particles() const { return members_.particles(); }
  /// Particles that it resamples in step t: where groups append what they receive, these, too.
  std::size_t resampled(Step t) const {
    return particles() + (due(t) && cloud_.groups.exchange == Exchange::kAppend ? travellers_.size() : 0);
  }

  /// One step with its estimates; move() is what a rank does with its particles before they are weighed up against the
  /// others', resample() after the exchange.
  template <class Move, class Resample>
  void step(Step t, const Move& move, const Resample& resample) {
    move();
    ask_all(3);                      // largest weight, sums of weights and of their squares
    ask_all(2 * cloud_.dimensions);  // mean and deviation
    if (due(t)) exchange(t);
    resample();
    ask_all(1);  // whether any group resampled
  }

 private:
  bool due(Step t) const {
    return cloud_.groups.exchanges() && static_cast<std::size_t>(t) % cloud_.groups.exchange_every == 0;
  }
  /// Particles that a group sends.
  std::size_t leaving() const {
    return cloud_.groups.exchange_count * degree(cloud_.groups.topology, cloud_.groups.groups);
  }
  /// A number of every group to all, so many times.
  void ask_all(std::size_t times) const {
    for (std::size_t k = 0; k < times; ++k) members_.of_all(std::vector<double>(members_.end() - members_.begin()));
  }
  void exchange(Step t) {
    dealt(travellers_, std::span<const double>(log_weights_), sent_, members_, cloud_.groups,
          static_cast<std::size_t>(t) / cloud_.groups.exchange_every);
    if (cloud_.groups.exchange == Exchange::kReplace) ask_all(1);  // what was lost
  }

  GroupCloud cloud_;
  TeamMembership members_;
  ByGroup sent_;             // by group here
  Particles<R> travellers_;  // that leave in an exchange
  std::vector<double> log_weights_;
};

}  // namespace mote

#pragma once
/// The groups of a distributed filter on a team of processes.

#include <algorithm>

#include "mote/engine/team.hpp"
#include "mote/filter/chain.hpp"
#include "mote/filter/membership.hpp"

namespace mote {

/// Groups shared out to the ranks of a team: a run of them each, the first ranks with one more where they cannot be
/// shared evenly.
///
/// shape   at most as many ranks as groups
/// cost    of_all: eight bytes a group to everyone; carry: a message for each letter that leaves its rank
class TeamMembership final : public Membership {
 public:
  TeamMembership(const Groups& groups, Team& team)
      : Membership(groups, Cut(groups.count(), team.ranks()).begin(team.rank()),
                   Cut(groups.count(), team.ranks()).begin(team.rank() + 1)),
        team_(&team) {
    const Cut ranks(groups.count(), team.ranks());
    for (std::size_t r = 0; r <= team.ranks(); ++r) {
      groups_before_.push_back(ranks.begin(r));
      particles_before_.push_back(r == team.ranks() ? groups.particles() : groups.first(ranks.begin(r)));
    }
  }

  std::vector<double> of_all(std::vector<double> here) const override {
    std::vector<double> all(groups().count());
    std::copy(here.begin(), here.end(), all.begin() + static_cast<std::ptrdiff_t>(begin()));
    team_->complete(std::as_writable_bytes(std::span(all)), groups_before_);
    return all;
  }
  void carry(std::span<const Letter> out, std::span<Letter> in) const override {
    std::vector<ParcelOut> parcels_out;
    std::vector<ParcelIn> parcels_in;
    for (const Letter& letter : out) parcels_out.push_back({rank_of(letter.to), letter.bytes});
    for (Letter& letter : in) parcels_in.push_back({rank_of(letter.from), letter.bytes});
    team_->exchange(parcels_out, parcels_in);
  }
  void complete(std::span<std::byte> column) const override { team_->complete(column, particles_before_); }

 private:
  std::size_t rank_of(std::size_t group) const {
    return static_cast<std::size_t>(std::upper_bound(groups_before_.begin(), groups_before_.end(), group) -
                                    groups_before_.begin()) -
           1;
  }

  Team* team_;
  std::vector<std::size_t> groups_before_, particles_before_;  // by rank; then all
};

}  // namespace mote

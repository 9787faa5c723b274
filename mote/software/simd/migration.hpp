#pragma once
/// Migration: children that are born on one rank of a team and live on another.
///
/// Systematic resampling keeps the order of the particles, so what a rank's particles have is a run of children; those
/// inside the rank's own share stay, the others go to the ranks that own their places. A rank sends to and receives
/// from those ranks only, whose shares its children, or its parents, reach into: its neighbours while weights are even.

#include "mote/software/share.hpp"
#include "mote/software/simd/survivors.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// The children of one step on their way.
///
/// cost    the children that change ranks, twice; memory as much, and a column set of the share for those that arrive
template <class R, std::size_t kD>
class Migration {
 public:
  Migration(std::size_t particles, std::size_t dimensions, Team& team)
      : team_(&team), home_(particles, &team), arrived_(dimensions, home_.count), leaving_(dimensions) {
    for (std::size_t r = 0; r < team.ranks(); ++r) owned_.emplace_back(particles, team.ranks(), r);
  }

  /// Sends and receives the children of the map, whose parents are particles of x on this rank.
  void move(const ChildMap& map, const Particles<R>& x, const R* weights, SurvivorStream<R, kD>& stream,
            const ColumnPointers<R, kD>& desk) {
    const lanes::SubnormalsAreZero as_in_a_pass;  // or survivors could be others
    const std::size_t me = team_->rank();
    const auto share = [&](std::size_t parents, std::size_t owner) {  // children of one rank that live on another
      const auto first = std::max<std::size_t>(map.born[parents], owned_[owner].first);
      return std::pair{first, std::max(first, std::min<std::size_t>(map.born[parents + 1], owned_[owner].end()))};
    };
    std::tie(stay_first_, stay_end_) = share(me, me);
    std::size_t leaving = 0;
    for (std::size_t r = 0; r < team_->ranks(); ++r)
      if (const auto [first, end] = share(me, r); r != me) leaving += end - first;
    for (auto& column : leaving_) column.resize(leaving);
    out_.clear();
    in_.clear();
    std::size_t at = 0;
    for (std::size_t r = 0; r < team_->ranks(); ++r) {
      if (r == me) continue;
      if (const auto [first, end] = share(me, r); first < end) {
        write_out(map, x, weights, stream, desk, first, end, at);
        for (auto& column : leaving_) out_.push_back({r, std::as_bytes(std::span(column).subspan(at, end - first))});
        at += end - first;
      }
      if (const auto [first, end] = share(r, me); first < end)
        for (std::size_t d = 0; d < arrived_.dimensions(); ++d)
          in_.push_back({r, std::as_writable_bytes(arrived_.component(d).subspan(first - home_.first, end - first))});
    }
    team_->exchange(out_, in_);
  }

  /// Prepares a stream for the children of this rank from place `first` on.
  void begin(const ChildMap& map, const Particles<R>& x, const R* weights, std::size_t first,
             SurvivorStream<R, kD>& stream) const {
    const std::size_t child = std::max(home_.first + first, stay_first_);
    if (child < stay_end_) stream.begin(map, x, weights, static_cast<std::uint32_t>(child));
  }

  /// Writes the children at places [first, first + count) of this rank, at most a block; calls come in order.
  void fetch(std::size_t first, std::size_t count, SurvivorStream<R, kD>& stream, const ColumnPointers<R, kD>& to,
             Particles<R>& spare) const {
    const std::size_t child = home_.first + first;
    const std::size_t stay_first = std::clamp(stay_first_, child, child + count);
    const std::size_t stay_end = std::clamp(stay_end_, stay_first, child + count);
    const auto from = static_cast<std::uint32_t>(stay_first);
    if (stay_first < stay_end && stay_first == child) stream.write(from, stay_end - stay_first, to);
    if (stay_first < stay_end && stay_first > child) {  // a stream writes to whole vectors' places only
      auto columns = column_pointers<R, kD>(arrived_.dimensions());
      for (std::size_t d = 0; d < columns.size(); ++d) columns[d] = spare.component(d).data();
      stream.write(from, stay_end - stay_first, columns);
      for (std::size_t d = 0; d < columns.size(); ++d)
        std::copy_n(columns[d], stay_end - stay_first, to[d] + (stay_first - child));
    }
    for (std::size_t d = 0; d < arrived_.dimensions(); ++d) {
      const R* const column = arrived_.component(d).data() + first;
      std::copy(column, column + (stay_first - child), to[d]);
      std::copy(column + (stay_end - child), column + count, to[d] + (stay_end - child));
    }
  }

 private:
  /// Children [first, end) into the columns of those that leave, from place `at` on.
  void write_out(const ChildMap& map, const Particles<R>& x, const R* weights, SurvivorStream<R, kD>& stream,
                 const ColumnPointers<R, kD>& desk, std::size_t first, std::size_t end, std::size_t at) {
    stream.begin(map, x, weights, static_cast<std::uint32_t>(first));
    for (std::size_t child = first; child < end; child += kBlock) {
      const std::size_t count = std::min(kBlock, end - child);
      stream.write(static_cast<std::uint32_t>(child), count, desk);
      for (std::size_t d = 0; d < leaving_.size(); ++d)
        std::copy_n(desk[d], count, leaving_[d].data() + at + (child - first));
    }
  }

  Team* team_;
  Share home_;
  std::vector<Share> owned_;                   // by rank
  std::size_t stay_first_ = 0, stay_end_ = 0;  // children of this rank that stay
  Particles<R> arrived_;                       // by place; those that stay are not among them
  std::vector<AlignedVector<R>> leaving_;
  std::vector<ParcelOut> out_;
  std::vector<ParcelIn> in_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

#pragma once
/// The checkpoint of a team: the states of all ranks in one file, which rank 0 reads and writes.

#include <vector>

#include "mote/app/files/checkpoint_file.hpp"
#include "mote/engine/team.hpp"

namespace mote {

/// A rank's part in a checkpoint of its team: one file, so that the states in it are always of the same step.
///
/// error   on rank 0 as CheckpointFile; the others do not know of it
/// cost    the states of all ranks through rank 0, twice; memory for one rank's at a time; four bytes a rank and step
/// to
///         agree on the time
class TeamCheckpoint final : public Checkpoint {
 public:
  /// `file`: of rank 0, null on the others.
  TeamCheckpoint(Team& team, CheckpointFile* file) : team_(&team), file_(file) {}

  bool resume(const KeepRun& run) override;
  void step_done(const KeepRun& run) override;
  void stopped(const KeepRun& run) override { write(run); }

 private:
  void write(const KeepRun& run);
  /// What rank 0 says.
  bool told(bool mine) { return team_->gather(mine ? 1U : 0U)[0] != 0; }
  /// Hands bytes from one rank to another; all ranks call it.
  void hand_over(std::size_t from, std::size_t to, std::vector<char>& bytes);

  Team* team_;
  CheckpointFile* file_;
};

}  // namespace mote

#pragma once
/// The checkpoint of a team: the states of all ranks in one file, which rank 0 reads and writes.

#include <atomic>
#include <vector>

#include "mote/app/files/checkpoint_file.hpp"
#include "mote/engine/team.hpp"

namespace mote {

/// A rank's part in a checkpoint of its team: one file, so that the states in it are always of the same step. A signal
/// to any rank stops all after the same step, too.
///
/// error   on rank 0 as CheckpointFile; the others do not know of it
/// cost    the states of all ranks through rank 0, twice; memory for one rank's at a time; four bytes a rank and step
/// to
///         agree on what to do
class TeamCheckpoint final : public Checkpoint {
 public:
  /// `file`: of rank 0, null on the others; `signalled`: set by a signal to this rank.
  TeamCheckpoint(Team& team, CheckpointFile* file, const std::atomic<bool>& signalled)
      : team_(&team), file_(file), signalled_(&signalled) {}

  /// Set on all ranks when one of them was signalled.
  const std::atomic<bool>& stop() const { return stop_; }

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
  const std::atomic<bool>* signalled_;
  std::atomic<bool> stop_{false};
};

}  // namespace mote

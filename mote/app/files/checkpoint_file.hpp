#pragma once
/// A checkpoint in a file: written whole or not at all, read only by the run that it belongs to.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "mote/app/files/facts.hpp"
#include "mote/engine/checkpoint.hpp"

namespace mote {

/// A file that a run is kept in. It holds: "mote checkpoint\n", the version of what follows, the file's length, the
/// facts, the run's state, the CRC-32 of all before. Numbers lie as in memory of an x86-64.
///
/// It is written aside, handed to the disk and renamed: whatever ends the program or the machine, the file is the old
/// one or the new one.
///
/// error   on making one: Refusal (kBadData) when there is a file that is no checkpoint, of another version, cut short
///         or damaged; (kWrongUse) when it belongs to another run, or can be no file; (kCannotWrite) when none can be
///         written there. On writing: Refusal (kCannotWrite), and the old file stays
/// cost    a pass over the state for the checksum, and the disk
class CheckpointFile final : public Checkpoint {
 public:
  /// `every`: steps between two checkpoints; empty: ten seconds, or longer if a checkpoint takes more than a twentieth
  /// of that.
  CheckpointFile(std::string path, RunFacts facts, std::optional<std::size_t> every);

  /// Whether there is a file that the run will go on from.
  bool found() const { return state_at_.has_value(); }

  bool resume(const KeepRun& run) override;
  void step_done(const KeepRun& run) override {
    if (due()) write(run);
  }
  void stopped(const KeepRun& run) override { write(run); }

  /// Counts a step; whether it is time to write.
  bool due();
  /// Writes the file; calls run kPasses times, to learn its length first.
  void write(const KeepRun& run);
  static constexpr int kPasses = 2;

  /// Removes the file: its run is done, and its outputs are written.
  void remove() const;

 private:
  using Clock = std::chrono::steady_clock;

  void check_file();
  void check_facts(const RunFacts& kept) const;

  std::string path_;
  RunFacts facts_;
  std::optional<std::size_t> every_;
  std::optional<std::uint64_t> state_at_;  // where the state begins in the file there is
  std::uint64_t state_bytes_ = 0;
  std::size_t steps_ = 0;  // since the last one
  Clock::time_point last_ = Clock::now();
  Clock::duration pause_;  // until the next one, where no number of steps is set
};

}  // namespace mote

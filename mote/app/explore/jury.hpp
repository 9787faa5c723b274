#pragma once
/// The jury: recordings with their posterior means, by which every candidate is judged alike.

#include "mote/app/compare/study.hpp"
#include "mote/app/explore/journal.hpp"

namespace mote::explore {

/// Run r of every candidate is on recording r mod K, with a seed of its own that is the same for all.
class Jury {
 public:
  /// shape   design: scenes, target, seed and reference are read; its repeats are as many as runs need
  explicit Jury(compare::Design design) : design_(std::move(design)) {}

  const compare::Design& design() const { return design_; }
  const Recording& recording(std::size_t run) const { return design_.scenes[recording_of(run)].recording; }
  std::uint64_t seed(std::size_t run) const { return design_.seed_of(recording_of(run), run / design_.scenes.size()); }
  /// Errors of a candidate's run.
  Errors judged(const Target& target, std::size_t candidate, std::size_t run) const;

 private:
  std::size_t recording_of(std::size_t run) const { return run % design_.scenes.size(); }

  compare::Design design_;
};

}  // namespace mote::explore

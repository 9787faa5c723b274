#include "mote/app/explore/jury.hpp"

#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {

Errors Jury::judged(const Target& target, std::size_t candidate, std::size_t run) const {
  compare::Measured found{.seed = seed(run), .recording = recording_of(run)};
  try {
    compare::measure(design_, target.run(candidate, recording(run), seed(run)), found);
  } catch (const Refusal& refusal) {
    if (refusal.code() != ExitCode::kCollapsed) throw;
    return {kInfinity, design_.has_truth() ? kInfinity : kNaN};
  }
  return {found.mse_reference, found.mse_truth};
}

}  // namespace mote::explore

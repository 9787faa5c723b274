#pragma once
/// What ends the work on an item.

#include "mote/app/terminal/signals.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {

/// A wrong word inside an item is a fault of the item's file, not of the command line.
template <class Make>
auto as_bad_data(Make&& make) {
  try {
    return make();
  } catch (const Refusal& refusal) {
    if (refusal.code() != ExitCode::kWrongUse) throw;
    throw Refusal(ExitCode::kBadData, std::string(refusal.what()));
  }
}

/// error   Refusal (kInterrupted) once the user has stopped the program
inline void refuse_when_stopped() {
  if (stop_flag()) throw Refusal(ExitCode::kInterrupted, "mote reproduce: interrupted; no file was written.");
}

}  // namespace mote::reproduce

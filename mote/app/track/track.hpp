#pragma once
/// `mote track` itself: what the program mote-track does.

#include "mote/app/commands/command.hpp"

namespace mote {

ExitCode run_track(const Arguments& arguments);

}  // namespace mote

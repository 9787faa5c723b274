#pragma once
/// `mote train` itself: a vehicle detector from pictures of vehicles and of other things.

#include "mote/app/commands/command.hpp"

namespace mote {

ExitCode run_train(const Arguments& arguments);

}  // namespace mote

#pragma once
/// Ctrl-C and SIGTERM as a flag that work looks at.

#include <atomic>

namespace mote {

/// From the first call on, SIGINT and SIGTERM set the flag instead of ending the program; a second one ends it.
const std::atomic<bool>& stop_flag();

}  // namespace mote

#pragma once
/// Signals: Ctrl-C, SIGTERM and SIGHUP as a flag that work looks at; failed writes as failed writes.

#include <atomic>

namespace mote {

/// From the first call on, SIGINT, SIGTERM and SIGHUP set the flag instead of ending the program; a second one ends it.
/// What the caller of the program has switched off (nohup, a job in the background) stays off.
const std::atomic<bool>& stop_flag();

/// A reader that goes away and a file that reaches its limit are failed writes, not an end of the program.
void let_writes_fail();

/// Gives a closed standard stream a place that refuses writing, so that no file that is opened takes its number.
void occupy_closed_streams();

}  // namespace mote

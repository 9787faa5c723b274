#pragma once
/// How much memory there is.

namespace mote {

/// Memory that this program can still have, bytes: what the machine has available, within the limits of its control
/// group (a container) and of `ulimit -v`; infinity where nobody says.
double available_memory();

}  // namespace mote

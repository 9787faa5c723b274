#pragma once
/// Processes that mpirun starts by one command line: what is wrong with it is to be said once.

#include <chrono>

namespace mote {

/// Whether this process is to say what is wrong with the words it was started by: the first of those that mpirun
/// (Open MPI's) started by the same words is, and whoever was not started by mpirun. mpirun ends all when one of them
/// ends with an error; who is still there after `patience` says it, too, since the first must have had another fate.
/// False, within that time, when a signal that is handled ends the wait.
bool speaks_for_job(std::chrono::milliseconds patience = std::chrono::seconds(10));

}  // namespace mote

#pragma once
/// Teams of processes that mpirun starts.

#include <memory>
#include <string>

#include "mote/engine/team.hpp"

namespace mote {

/// The process's part in MPI, from its beginning to its end.
class MpiSession {
 public:
  MpiSession(int& count, char**& words);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  MpiSession(MpiSession&&) = delete;
  MpiSession& operator=(MpiSession&&) = delete;

  /// Ends every process of the job at once; mpirun returns the code.
  [[noreturn]] static void abort(int code);
};

/// All processes of the job as a team.
///
/// cost    largest, add, before, gather, share: O(log R) messages one after the other; exchange: a message for each
///         parcel, or gigabyte of one; complete: as MPI_Allgatherv; send: a copy, and a wait where 64 messages have not
///         arrived yet
std::unique_ptr<Team> make_mpi_team();

}  // namespace mote

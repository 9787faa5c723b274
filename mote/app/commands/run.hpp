#pragma once
/// `mote run`, alone or on a rank of a team.

#include "mote/app/commands/command.hpp"
#include "mote/engine/team.hpp"

namespace mote {

/// A refusal that all ranks of a team have come to together, so that none waits for another: one of them says it, the
/// sentence of the others is empty.
class CommonRefusal : public Refusal {
 public:
  CommonRefusal(const Refusal& refusal, bool said) : Refusal(refusal.code(), said ? refusal.what() : "") {}
};

/// Runs the command in this process.
ExitCode run_alone(const Arguments& arguments);

/// Runs the command on a rank of a team. Every rank reads the data, rank 0 alone writes.
///
/// error   CommonRefusal for what stops all ranks; what another exception stops the others do not know of
ExitCode run_in_team(const Arguments& arguments, Team& team);

}  // namespace mote

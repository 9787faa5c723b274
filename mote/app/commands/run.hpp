#pragma once
/// `mote run`, alone or on a rank of a team.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/engine/team.hpp"
#include "mote/report/page.hpp"

namespace mote {

/// A refusal that all ranks of a team have come to together, so that none waits for another: one of them says it, the
/// sentence of the others is empty.
class CommonRefusal : public Refusal {
 public:
  CommonRefusal(const Refusal& refusal, bool said) : Refusal(refusal.code(), said ? refusal.what() : "") {}
};

/// What filters a job in place of the engines.
struct OtherMachine {
  std::unique_ptr<Filter> filter;
  std::string engine;                                 ///< its name, for outputs
  std::vector<report::Fact> facts;                    ///< for the report
  nlohmann::json summary = nlohmann::json::object();  ///< more members of the summary
};
using MachineMaker = std::function<OtherMachine(const Job& job, const Plan& plan)>;

/// Runs the command in this process; with `make`, on another machine.
ExitCode run_alone(const Arguments& arguments, const MachineMaker& make = {});

/// Options of files: what a run reads and writes.
std::vector<OptionSpec> run_file_options();

/// Runs the command on a rank of a team. Every rank reads the data, rank 0 alone writes.
///
/// error   CommonRefusal for what stops all ranks; what another exception stops the others do not know of
ExitCode run_in_team(const Arguments& arguments, Team& team);

}  // namespace mote

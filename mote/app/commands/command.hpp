#pragma once
/// Commands are data: one list of options gives the command line, its help and its checks.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mote/app/terminal/ranks.hpp"
#include "mote/base/refusal.hpp"

namespace mote {

/// One option of a command.
struct OptionSpec {
  std::string flags;     ///< "-n,--particles"
  std::string value;     ///< what follows it: "N", "FILE"; empty for a flag
  std::string fallback;  ///< its default as text; empty = none
  std::string meaning;   ///< with unit and range
  std::string group;     ///< heading in the help
  bool many = false;     ///< may be given several times
};

/// A word before the options.
struct PositionalSpec {
  std::string name, meaning;
  bool required = true;
  bool many = false;  ///< may be given several times
};

/// The options given on one command line.
class Arguments {
 public:
  Arguments(std::string where, std::string command_line, std::map<std::string, std::vector<std::string>> given,
            std::map<std::string, std::string> fallbacks)
      : where_(std::move(where)),
        command_line_(std::move(command_line)),
        given_(std::move(given)),
        fallbacks_(std::move(fallbacks)) {}

  /// "mote run": what opens a refusal.
  const std::string& where() const { return where_; }
  /// The command line as a shell takes it again.
  const std::string& command_line() const { return command_line_; }
  bool given(const std::string& name) const { return given_.contains(name); }
  /// The text of an option, or its default.
  std::string text(const std::string& name) const;
  std::vector<std::string> list(const std::string& name) const;
  /// An integer in [least, most]; `other` names what else may be given ("auto, or ").
  long long integer(const std::string& name, long long least, long long most, const std::string& other = "") const;
  double number(const std::string& name, double least, double most) const;
  /// The place of the option's text among the choices.
  std::size_t choice(const std::string& name, const std::vector<std::string>& choices) const;
  /// The text of an option that must be given.
  std::string required(const std::string& name, const std::string& expected, const std::string& next) const;

 private:
  std::string pass_default(const std::string& name) const;

  std::string where_, command_line_;
  std::map<std::string, std::vector<std::string>> given_;
  std::map<std::string, std::string> fallbacks_;
};

/// A command of the program. One without `run` has parts: commands named "<its name> <part>", listed after it.
struct Command {
  std::string name, summary;
  std::vector<PositionalSpec> positionals;
  std::vector<OptionSpec> options;
  std::function<ExitCode(const Arguments&)> run;
  std::string footer;
};

/// Options given as words, as on a command line (for commands that run others).
///
/// error   Refusal (kWrongUse) for words that are no option
Arguments arguments_from(const std::string& where, const std::vector<OptionSpec>& options,
                         const std::vector<std::string>& words);

Command models_command();
Command simulate_command();
Command simulate_cluster_command();
Command compare_command();
Command graph_command();
Command rtl_command();
Command design_command();
Command design_check_command();
Command design_laws_command();
Command design_measure_command();
Command design_optimise_command();
Command design_explore_command();
Command analog_command();
Command analog_characterise_command();
Command analog_run_command();
Command analog_power_command();
Command bench_command();
Command reproduce_command();

/// `mote run`; with --engine mpi it is performed by `team`: the program mote-mpi has teams, mote hands its words over
/// to it.
Command run_command(std::function<ExitCode(const Arguments&)> team);

/// `mote track`, performed by `track`: the program mote-track has the tracker, mote hands its words over to it.
Command track_command(std::function<ExitCode(const Arguments&)> track);
Command train_command(std::function<ExitCode(const Arguments&)> train);

/// Parses and runs one of the commands: what main() returns. `speaks` is asked whether this process is the one to say
/// that its words are wrong.
int run_program(
    int count, char** words, const std::vector<Command>& commands_known,
    const std::function<bool()>& speaks = [] { return speaks_for_job(); });

}  // namespace mote

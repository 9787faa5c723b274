#include "mote/app/commands/command.hpp"
namespace mote {
Command reproduce_command() {
  return {"reproduce",
          "Regenerate the papers' figures and tables",
          {{"PAPER", "imh-hw, fpga, mixed, imh-opt, ppf or all"}},
          {{"--out", "DIR", "", "folder for figures, report and comparison.json", "Output"}},
          [](const Arguments&) { return ExitCode::kDone; },
          ""};
}
}  // namespace mote

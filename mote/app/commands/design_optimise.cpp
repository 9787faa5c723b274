#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/design/report.hpp"
#include "mote/app/files/output.hpp"

namespace mote {
namespace {

ExitCode run_optimise(const Arguments& arguments) {
  const DesignRequest request = design_request_from(arguments);
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  const DesignReport report = design_report(request);
  if (json != nullptr) json->write(design_json(report).dump(2) + "\n");
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", design_text(report));
  return ExitCode::kDone;
}

}  // namespace

Command design_optimise_command() {
  std::vector<OptionSpec> options = design_options();
  options.push_back(
      {"--json", "FILE", "", "cases, whole numbers, sensitivity as JSON; - is standard output [none]", "Output"});
  return {"design optimise",
          "How many proposers, weighers and chains",
          {},
          std::move(options),
          run_optimise,
          "A budget that nothing keeps is answered by the nearest design. Exit codes: 0 done, 2 wrong use, 6 cannot "
          "write."};
}

}  // namespace mote

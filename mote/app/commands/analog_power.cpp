#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/analog/power_report.hpp"
#include "mote/app/files/output.hpp"

namespace mote {
namespace {

ExitCode run_power(const Arguments& arguments) {
  OutputSet outputs;
  for (const std::string& path : arguments.list("--fpga")) outputs.protect(path);
  Output* json = outputs.open(arguments.text("--json"));
  Output* report = outputs.open(arguments.text("--report"));
  const PowerRequest request = power_request_from(arguments);
  if (json != nullptr) json->write(power_json(request).dump(2) + "\n");
  if (report != nullptr) report->write(report::html(power_page(request, arguments.command_line())));
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", power_text(request));
  return ExitCode::kDone;
}

}  // namespace

Command analog_power_command() {
  std::vector<OptionSpec> options = power_options();
  options.push_back({"--json", "FILE", "", "tables and ratios as JSON; - is standard output [none]", "Output"});
  options.push_back({"--report", "FILE", "", "report with plots, one HTML file [none]", "Output"});
  return {"analog power",
          "What analog and digital parts take",
          {},
          std::move(options),
          run_power,
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 5 ngspice missing, 6 cannot write."};
}

}  // namespace mote

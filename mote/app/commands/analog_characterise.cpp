#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/analog/characterisation.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/terminal/progress.hpp"

namespace mote {
namespace {

ExitCode run_characterise(const Arguments& arguments) {
  const CharacteriseRequest request = characterise_request_from(arguments);
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  Output* report = outputs.open(arguments.text("--report"));
  Characterisation found;
  {
    Progress progress("circuits");
    found = characterisation(request, [&](std::size_t done, std::size_t all) { progress.update(done, all); });
  }
  if (json != nullptr) json->write(characterisation_json(found).dump(2) + "\n");
  if (report != nullptr) {
    report::Page page = characterisation_page(found);
    page.command = arguments.command_line();
    report->write(report::html(page));
  }
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", characterisation_text(found));
  return ExitCode::kDone;
}

}  // namespace

Command analog_characterise_command() {
  std::vector<OptionSpec> options = characterise_options();
  options.push_back({"--json", "FILE", "", "the figures as JSON; - is standard output [none]", "Output"});
  options.push_back({"--report", "FILE", "", "report with plots, one HTML file [none]", "Output"});
  return {
      "analog characterise",
      "Error, power and speed of the arctan and Gaussian circuits",
      {},
      std::move(options),
      run_characterise,
      "The circuits are simulated by ngspice. Exit codes: 0 done, 2 wrong use, 5 ngspice is missing, 6 cannot write."};
}

}  // namespace mote

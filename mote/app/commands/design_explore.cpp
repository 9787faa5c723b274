#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/text_entry.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/compare/scenes.hpp"
#include "mote/app/explore/publication.hpp"
#include "mote/app/explore/request.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"

namespace mote {
namespace {

using namespace explore;

void protect_inputs(OutputSet& outputs, const Arguments& arguments) {
  outputs.protect(arguments.text("--data"));
  outputs.protect(arguments.text("--truth"));
  if (is_text_model(arguments.text("MODEL"))) outputs.protect(arguments.text("MODEL"));
  for (const std::string& setting : arguments.list("--set"))
    if (setting.starts_with("file=")) outputs.protect(setting.substr(5));
}

/// Where findings are kept: as told, or beside the JSON file.
std::string state_file(const Arguments& arguments) {
  if (arguments.given("--state")) return arguments.text("--state");
  const std::string json = arguments.text("--json");
  return json.empty() || names_stream(json) ? "" : json + ".state";
}

compare::Reference reference_of(const compare::Design& design) {
  Progress progress("recordings of the reference");
  return compare::usual_reference(
      design, [&](std::size_t done, std::size_t all) { progress.update(done, all); }, stop_flag());
}

/// A bar for each thing that is counted.
class Bars {
 public:
  void update(const char* what, std::size_t done, std::size_t all) {
    if (what_ != what) bar_.emplace(what_ = what);
    bar_->update(done, all);
  }

 private:
  std::string what_;
  std::optional<Progress> bar_;
};

ExitCode run_explore(const Arguments& arguments) {
  Material material = material_from(arguments);
  const std::unique_ptr<Target> target = target_from(arguments, material);
  const Order order = order_from(arguments, *target);
  OutputSet outputs;
  protect_inputs(outputs, arguments);
  const std::string state = state_file(arguments);
  outputs.reserve(state);
  Output* json = outputs.open(arguments.text("--json"));
  Output* page = outputs.open(arguments.text("--report"));
  for (const std::string& note : material.notes) fmt::print(stderr, "{}\n", printable(note));
  Journal journal(state, facts_of(arguments, material, *target));
  material.design.reference = reference_of(material.design);
  const Jury jury(std::move(material.design));
  Exploration found{arguments.text("MODEL"),
                    arguments.command_line(),
                    material.source,
                    arguments.given("--data") ? arguments.text("--data") : "obs.csv",
                    target.get(),
                    &jury,
                    order,
                    {}};
  {
    Bars bars;
    const Told told = [&](const char* what, std::size_t done, std::size_t all) { bars.update(what, done, all); };
    found.finding = search(*target, jury, journal, order, told, stop_flag());
  }
  if (json != nullptr) json->write(exploration_json(found).dump(2) + "\n");
  if (page != nullptr) page->write(report::html(exploration_page(found)));
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", exploration_text(found));
  return ExitCode::kDone;
}

}  // namespace

Command design_explore_command() {
  std::vector<OptionSpec> options = explore_options();
  options.push_back(
      {"--json", "FILE", "", "pick, frontier and all candidates as JSON; - is standard output [none]", "Output"});
  options.push_back({"--report", "FILE", "", "report with the frontier, one HTML file [none]", "Output"});
  return {"design explore",
          "Which filter, on what, with how many of what",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
          std::move(options),
          run_explore,
          "Budgets that nothing keeps are answered by the nearest design. Exit codes: 0 done, 2 wrong use, 3 bad data, "
          "4 every filter collapsed, 5 outside tool, 6 cannot write, 130 interrupted."};
}

}  // namespace mote

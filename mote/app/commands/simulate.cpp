#include <fmt/format.h>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"

namespace mote {
namespace {

constexpr long long kMostSteps = 10'000'000;
constexpr long long kMostColumns = 4096;

/// The header that a model sizes itself by: for doa, as many columns as asked for.
std::vector<std::string> asked_columns(const Arguments& arguments) {
  std::vector<std::string> header;
  for (long long m = 1; m <= arguments.integer("--columns", 1, kMostColumns); ++m)
    header.push_back("doa" + std::to_string(m));
  return header;
}

std::string data_csv(const Simulation& simulation, const std::vector<Column>& columns) {
  std::string csv = "t";
  for (const Column& column : columns) csv += "," + column.name;
  csv += '\n';
  for (std::size_t k = 0; k < simulation.rows.size(); ++k) {
    csv += std::to_string(k + 1);
    for (const double value : simulation.rows[k].values) csv += "," + exact(value);
    csv += '\n';
  }
  return csv;
}

std::string truth_csv(const Simulation& simulation, const std::vector<Quantity>& states) {
  std::string csv = "t";
  for (const Quantity& state : states) csv += "," + state.name;
  csv += '\n';
  for (std::size_t k = 0; k < simulation.states.size(); ++k) {
    csv += std::to_string(k + 1);
    for (const double value : simulation.states[k]) csv += "," + exact(value);
    csv += '\n';
  }
  return csv;
}

ExitCode run_simulate(const Arguments& arguments) {
  const CatalogueEntry& entry = find_model(arguments.text("MODEL"), arguments.where());
  const auto header = asked_columns(arguments);
  const auto model = entry.make(Settings(arguments.where(), arguments.list("--set")), header);
  const auto steps = static_cast<Step>(arguments.integer("--steps", 1, kMostSteps));
  const auto seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  OutputSet outputs;
  Output* data = outputs.open(arguments.required("--out", "a file for the observations", "Pass --out obs.csv."));
  Output* truth = outputs.open(arguments.text("--truth"));
  const Simulation simulation = model->simulate(steps, seed);
  data->write(data_csv(simulation, model->columns()));
  if (truth != nullptr) truth->write(truth_csv(simulation, model->states()));
  outputs.commit();
  return ExitCode::kDone;
}

}  // namespace

Command simulate_command() {
  return {"simulate",
          "Draw a recording from a model",
          {{"MODEL", "model of the catalogue (see mote models)"}},
          {{"--steps", "T", "100", "number of steps, from 1 to 10000000", "Simulation"},
           {"--seed", "S", "1", "seed, an integer of at least 0", "Simulation"},
           {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated", "Simulation", true},
           {"--columns", "M", "1", "doa: directions per frame", "Simulation"},
           {"--out", "FILE", "", "observations as CSV", "Output"},
           {"--truth", "FILE", "", "true states as CSV", "Output"}},
          run_simulate,
          ""};
}

}  // namespace mote

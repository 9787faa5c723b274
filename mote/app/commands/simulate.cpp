#include <fmt/format.h>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/inputs.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"

namespace mote {
namespace {

constexpr long long kMostSteps = 10'000'000;
constexpr long long kMostColumns = 4096;

template <class Names>
std::string header_of(const Names& names) {
  std::string line = "t";
  for (const auto& named : names) line += "," + named.name;
  return line + '\n';
}

void write_line(Output& out, Step t, std::span<const double> values) {
  std::string line = std::to_string(t);
  for (const double value : values) line += "," + exact(value);
  out.write(line + '\n');
}

/// The note that `--columns` has no say in this model; empty when it has.
std::string note_on_columns(const Arguments& arguments, const CatalogueModel& model, std::size_t asked) {
  const std::size_t has = model.columns().size();
  if (!arguments.given("--columns") || has == asked) return "";
  return fmt::format("{}: note: --columns is not read: {} has {} column{} of its own.\n", arguments.where(),
                     arguments.text("MODEL"), has, has == 1 ? "" : "s");
}

ExitCode run_simulate(const Arguments& arguments) {
  const CatalogueEntry& entry = find_model(arguments.text("MODEL"), arguments.where());
  const auto header = frame_header(arguments.integer("--columns", 1, kMostColumns));
  const auto model = entry.make(Settings(arguments.where(), arguments.list("--set")), header);
  const auto steps = static_cast<Step>(arguments.integer("--steps", 1, kMostSteps));
  const auto seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  const std::atomic<bool>& stop = stop_flag();
  OutputSet outputs;
  protect_inputs(outputs, arguments, {});
  Output* data = outputs.open(arguments.required("--out", "a file for the observations", "Pass --out obs.csv."));
  Output* truth = outputs.open(arguments.text("--truth"));
  fmt::print(stderr, "{}", note_on_columns(arguments, *model, header.size()));
  data->write(header_of(model->columns()));
  if (truth != nullptr) truth->write(header_of(model->states()));
  {
    Progress progress("steps");
    model->simulate(steps, seed, [&](Step t, std::span<const double> state, const Row<double>& row) {
      if (stop)
        throw Refusal(ExitCode::kInterrupted, fmt::format("{}: interrupted after {} of {} steps; no file was written.",
                                                          arguments.where(), t - 1, steps));
      write_line(*data, t, row.values);
      if (truth != nullptr) write_line(*truth, t, state);
      progress.update(static_cast<std::size_t>(t), static_cast<std::size_t>(steps));
      return true;
    });
  }
  outputs.commit();
  return ExitCode::kDone;
}

}  // namespace

Command simulate_command() {
  return {
      "simulate",
      "Draw a recording from a model",
      {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
      {{"--steps", "T", "100", "number of steps, from 1 to 10000000", "Simulation"},
       {"--seed", "S", "1", "seed, an integer of at least 0; same seed, same recording", "Simulation"},
       {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Simulation", true},
       {"--columns", "M", "1", "doa: directions per frame, from 1 to 4096", "Simulation"},
       {"--out", "FILE", "", "observations as CSV; must be given; - is standard output", "Output"},
       {"--truth", "FILE", "", "true states as CSV [none]", "Output"}},
      run_simulate,
      ""};
}

}  // namespace mote

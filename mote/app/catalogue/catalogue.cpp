#include "mote/app/catalogue/catalogue.hpp"

#include <fmt/format.h>

#include "mote/app/terminal/suggestion.hpp"
#include "mote/base/refusal.hpp"

namespace mote {

Simulation CatalogueModel::simulate(Step steps, std::uint64_t seed) const {
  Simulation all;
  simulate(steps, seed, [&](Step, std::span<const double> state, const Row<double>& row) {
    all.states.emplace_back(state.begin(), state.end());
    all.rows.push_back(row);
    return true;
  });
  return all;
}

void refuse_without_team(const std::string& where) {
  throw Refusal(ExitCode::kWrongUse, {where, "--engine mpi", "the command mote run, which starts a team of processes",
                                      "another command", "Pass --engine simd, or leave it out."});
}

const CatalogueEntry& find_model(const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.name == name) return entry;
    known.push_back(entry.name);
  }
  const std::string names = fmt::format("{}", fmt::join(known, ", "));
  if (name.ends_with(".toml"))
    throw Refusal(ExitCode::kWrongUse,
                  {where, "MODEL", "one of " + names + " (this version of mote does not have models given as text yet)",
                   "\"" + name + "\"", "See mote models."});
  throw Refusal(ExitCode::kWrongUse,
                {where, "MODEL", "one of " + names, "\"" + name + "\"", hint(name, known, "See mote models.")});
}

}  // namespace mote

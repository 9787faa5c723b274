#include "mote/app/catalogue/catalogue.hpp"

#include <fmt/format.h>

#include "mote/app/catalogue/text_entry.hpp"
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

CatalogueEntry find_model(const std::string& name, const std::string& where) {
  if (is_text_model(name)) return text_entry(name);
  std::vector<std::string> known;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.name == name) return entry;
    known.push_back(entry.name);
  }
  const std::string names = fmt::format("{}", fmt::join(known, ", "));
  throw Refusal(ExitCode::kWrongUse, {where, "MODEL", "one of " + names + ", or a .toml file", "\"" + name + "\"",
                                      hint(name, known, "See mote models.")});
}

}  // namespace mote

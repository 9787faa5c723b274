#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/command.hpp"

namespace mote {
namespace {

nlohmann::json as_json(const CatalogueEntry& entry) {
  nlohmann::json json{{"name", entry.name}, {"meaning", entry.meaning}, {"columns", entry.example_columns}};
  for (const Quantity& s : entry.example_states)
    json["states"].push_back({{"name", s.name}, {"unit", s.unit}, {"angle", s.angle}});
  for (const ParameterInfo& p : entry.parameters)
    json["parameters"].push_back(
        {{"name", p.name}, {"default", p.fallback}, {"unit", p.unit}, {"allowed", p.allowed}, {"meaning", p.meaning}});
  for (const Named& g : entry.proposals) json["proposals"].push_back({{"name", g.name}, {"meaning", g.meaning}});
  return json;
}

void print_entry(const CatalogueEntry& entry) {
  fmt::print("{}: {}\n\nstates\n", entry.name, entry.meaning);
  for (const Quantity& s : entry.example_states) fmt::print("  {:<18}{}\n", s.name, s.unit);
  fmt::print("\ndata columns\n  t,{}\n\nparameters (--set name=value)\n", fmt::join(entry.example_columns, ","));
  std::size_t widest = 11;
  for (const ParameterInfo& p : entry.parameters) widest = std::max(widest, p.name.size());
  for (const ParameterInfo& p : entry.parameters)
    fmt::print("  {:<{}} [{}{}{}]  {} ({})\n", p.name, widest, p.fallback.empty() ? "none" : p.fallback,
               p.unit.empty() ? "" : " ", p.unit, p.meaning, p.allowed);
  fmt::print("\nproposals (--proposal NAME)\n");
  for (const Named& g : entry.proposals) fmt::print("  {:<18}{}\n", g.name, g.meaning);
}

ExitCode run_models(const Arguments& arguments) {
  const bool json = arguments.given("--json");
  if (arguments.given("NAME")) {
    const CatalogueEntry& entry = find_model(arguments.text("NAME"), arguments.where());
    if (json) {
      fmt::print("{}\n", as_json(entry).dump(2));
    } else {
      print_entry(entry);
    }
    return ExitCode::kDone;
  }
  if (json) {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& entry : catalogue()) all.push_back(as_json(entry));
    fmt::print("{}\n", all.dump(2));
  } else {
    for (const auto& entry : catalogue()) fmt::print("{:<18}{}\n", entry.name, entry.meaning);
    fmt::print("\nmote models NAME shows states, data columns, parameters and proposals.\n");
  }
  return ExitCode::kDone;
}

}  // namespace

Command models_command() {
  return {"models",
          "List the models, or show one with its parameters",
          {{"NAME", "model to show, or a .toml file", false}},
          {{"--json", "", "", "print as JSON", "Output"}},
          run_models,
          ""};
}

}  // namespace mote

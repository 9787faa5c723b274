#include "mote/app/catalogue/catalogue.hpp"

#include "mote/base/refusal.hpp"

namespace mote {

const CatalogueEntry& find_model(const std::string& name, const std::string& where) {
  std::string names;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.name == name) return entry;
    names += (names.empty() ? "" : ", ") + entry.name;
  }
  if (name.ends_with(".toml"))
    throw Refusal(ExitCode::kWrongUse,
                  where + ": " + name + ": this version of mote does not have models given as text yet. Pass one of " +
                      names + ".");
  throw Refusal(ExitCode::kWrongUse, {where, "MODEL", "one of " + names, "\"" + name + "\"", "See mote models."});
}

}  // namespace mote

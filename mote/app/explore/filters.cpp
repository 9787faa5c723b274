#include "mote/app/explore/filters.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "mote/app/terminal/shell.hpp"
#include "mote/engine/run.hpp"
#include "mote/model/model.hpp"

namespace mote::explore {
namespace {

/// Kinds with what they are tried with.
const std::vector<std::pair<std::string, std::vector<std::string>>>& kinds() {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> all{
      {"sisr", {""}},
      {"imh", {"", " --improved", " --improved --chains 32"}},
      {"auxiliary", {" --improved"}},
      {"sqmc", {""}},
      {"distributed", {" --groups 4 --exchange append", " --groups 16 --exchange append"}}};
  return all;
}

}  // namespace

std::vector<std::string> filters_of(const Space& space) {
  std::vector<std::string> names;
  for (const auto& [name, variants] : kinds()) names.push_back(name);
  const std::vector<std::string> wanted = kinds_of(space, names);
  const auto proposals = find_model(space.model, space.where).proposals;
  std::vector<std::string> all;
  for (const auto& [name, variants] : kinds()) {
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    for (const std::string& variant : variants) {
      const std::string filter = "--filter " + name + variant;
      all.push_back(filter);
      if (name != "sisr" && name != "auxiliary") continue;
      for (const Named& proposal : proposals)
        if (proposal.name != Prior::kName) all.push_back(filter + " --proposal " + proposal.name);
    }
  }
  return all;
}

Words words_in(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

RunRecord run_planned(const Space& space, const Plan& plan, const Recording& recording) {
  RunRequest request;
  request.where = space.where;
  request.states = space.catalogue_model->states();
  return mote::run(*space.catalogue_model->filter(plan, space.where), plan, recording, request);
}

RunRecord run_alone(const Space& space, Plan plan, const Recording& recording, std::uint64_t seed) {
  plan.threads = 1;
  plan.seed = seed;
  return run_planned(space, plan, recording);
}

std::string run_command_of(const Space& space, const Words& words, const std::string& data) {
  return fmt::format("mote run {}{} --data {} {} --out estimates.csv", shell_word(space.model), settings_of(space),
                     shell_word(data), fmt::join(words, " "));
}

}  // namespace mote::explore

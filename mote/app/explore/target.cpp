#include "mote/app/explore/target.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "mote/app/terminal/shell.hpp"
#include "mote/app/terminal/suggestion.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {

const std::vector<TargetKind>& target_kinds() {
  static const std::vector<TargetKind> all{{"cpu", "", "cpu", {}, processor},
                                           {"cluster", "", "cluster", {"--platform"}, cluster},
                                           {"mixed", "", "mixed", {"--currents", "--bits"}, mixed_mode},
                                           {"fpga", "DEVICE", "fpga:xc7a100t", {"--more-bits"}, device}};
  return all;
}

std::vector<Words> accepted(const Space& space, const std::vector<Words>& all, const std::string& needs,
                            const std::function<void(const Words&)>& accepts) {
  if (all.empty())
    throw Refusal(ExitCode::kWrongUse, {space.where, "--kinds, --particles, --workers", needs, "no candidate",
                                        "Leave some of them out, or pass others."});
  std::vector<Words> left;
  std::optional<Refusal> first;
  for (const Words& words : all) {
    try {
      accepts(words);
      left.push_back(words);
    } catch (const Refusal& refusal) {
      if (refusal.code() != ExitCode::kWrongUse) throw;
      if (!first) first = refusal;
    }
  }
  if (left.empty()) throw Refusal(*first);
  return left;
}

std::vector<std::string> kinds_of(const Space& space, const std::vector<std::string>& all) {
  for (const std::string& kind : space.kinds)
    if (std::find(all.begin(), all.end(), kind) == all.end())
      throw Refusal(ExitCode::kWrongUse, {space.where, "--kinds", fmt::format("some of {}", fmt::join(all, ", ")),
                                          '"' + kind + '"', hint(kind, all, "Leave --kinds out for all of them.")});
  std::vector<std::string> told = all;
  std::erase_if(told, [&](const std::string& kind) {
    return !space.kinds.empty() && std::find(space.kinds.begin(), space.kinds.end(), kind) == space.kinds.end();
  });
  return told;
}

std::string settings_of(const Space& space) {
  std::string text;
  for (const std::string& setting : space.settings) text += " --set " + shell_word(setting);
  return text;
}

}  // namespace mote::explore

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/design/check.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/software/threads.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

/// One kind of prediction, and how far it may be off.
struct Part {
  std::string name;
  double bound;  ///< on |measured / predicted - 1|
  std::vector<PredictionCheck> checks;
};

bool keeps(const PredictionCheck& check, double bound) { return std::abs(check.ratio - 1) <= bound; }

/// What is asked of each of the checks: of a circuit's step that the law is exact, of its run 3 %.
double bound_of(const Part& part, const PredictionCheck& check) {
  return check.what.find("imh") != std::string::npos && part.name == "circuit" ? 1e-12 : part.bound;
}

std::string check_text(const std::vector<Part>& parts) {
  std::string text =
      fmt::format("{:<9}{:<52}{:>12}{:>12}{:>9}{:>9}\n", "", "", "predicted", "measured", "ratio", "within");
  for (const Part& part : parts)
    for (const PredictionCheck& check : part.checks) {
      const double bound = bound_of(part, check);
      text += fmt::format("{:<9}{:<52}{:>12.6g}{:>12.6g}{:>9.4f}{:>9}{}\n", part.name, check.what, check.predicted,
                          check.measured, check.ratio, bound < 1e-9 ? "exact" : fmt::format("{:.0f} %", 100 * bound),
                          keeps(check, bound) ? "" : "  off");
    }
  return text;
}

Json check_json(const std::vector<Part>& parts) {
  Json all = Json::object();
  for (const Part& part : parts)
    for (const PredictionCheck& check : part.checks)
      all[part.name].push_back({{"what", check.what},
                                {"predicted", check.predicted},
                                {"measured", check.measured},
                                {"ratio", check.ratio},
                                {"bound", bound_of(part, check)},
                                {"keeps", keeps(check, bound_of(part, check))}});
  return all;
}

ExitCode run_check(const Arguments& arguments) {
  const std::vector<std::string> names{"threads", "circuit", "cluster"};
  std::vector<std::string> asked = arguments.list("PART");
  for (const std::string& name : asked)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), "PART", fmt::format("one of {}", fmt::join(names, ", ")),
                                          "\"" + name + "\"", "Name none for all of them."});
  if (asked.empty()) asked = names;
  const auto wants = [&](const char* name) { return std::find(asked.begin(), asked.end(), name) != asked.end(); };
  ThreadsCheck threads;
  threads.particles = static_cast<std::size_t>(arguments.integer("--particles", 1000, 10'000'000));
  threads.rounds = static_cast<int>(arguments.integer("--rounds", 1, 1000));
  threads.most_threads =
      arguments.given("--threads") ? static_cast<std::size_t>(arguments.integer("--threads", 1, 4096)) : cores();
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  std::vector<Part> parts;
  {
    Progress progress("measurements");
    std::size_t done = 0;
    const std::size_t all = (wants("threads") ? measurements_of(threads) : 0) +
                            (wants("circuit") ? kCircuitsChecked : 0) + (wants("cluster") ? kClustersChecked : 0);
    const CheckProgress ran = [&] { progress.update(++done, all); };
    if (wants("threads")) parts.push_back({"threads", 0.15, check_threads(threads, arguments.where(), ran)});
    if (wants("circuit")) parts.push_back({"circuit", 0.03, check_circuits(arguments.where(), ran)});
    if (wants("cluster")) parts.push_back({"cluster", 0.1, check_clusters(arguments.where(), ran)});
  }
  if (json != nullptr) json->write(check_json(parts).dump(2) + "\n");
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", check_text(parts));
  return ExitCode::kDone;
}

}  // namespace

Command design_check_command() {
  return {"design check",
          "What designs are chosen by, predicted and measured side by side",
          {{"PART", "threads, circuit or cluster; several of them [all]", false, true}},
          {{"-n,--particles", "N", "20000", "threads: particles, from 1000 to 10000000", "Work"},
           {"--threads", "K", "", "threads: the most that a design may have [all cores]", "Work"},
           {"--rounds", "R", "7", "threads: rounds, of which medians are said, from 1 to 1000", "Work"},
           {"--json", "FILE", "", "the same as JSON; - is standard output [none]", "Output"}},
          run_check,
          "A prediction that is off is said, and no error. Exit codes: 0 done, 2 wrong use, 5 outside tool, 6 cannot "
          "write."};
}

}  // namespace mote

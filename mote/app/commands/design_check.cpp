#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/design/check.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/software/threads.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

/// What was found of one kind of prediction.
struct Part {
  std::string name;
  std::vector<PredictionCheck> checks;
};

/// One kind of prediction.
struct PartKind {
  std::string name;
  std::size_t measurements;
  std::function<std::vector<PredictionCheck>(const CheckProgress&)> check;
};

/// All of them; the outside tools' first, so that a tool that is missing costs no wait.
std::vector<PartKind> part_kinds(const ThreadsCheck& threads, const std::string& where) {
  return {{"circuit", circuits_checked(), [=](const CheckProgress& ran) { return check_circuits(where, ran); }},
          {"cluster", clusters_checked(), [=](const CheckProgress& ran) { return check_clusters(where, ran); }},
          {"threads", measurements_of(threads),
           [=](const CheckProgress& ran) { return check_threads(threads, where, ran); }}};
}

/// Those that are asked for, in their own order; all of them if none is.
std::vector<PartKind> asked_for(const Arguments& arguments, std::vector<PartKind> kinds) {
  const std::vector<std::string> asked = arguments.list("PART");
  const auto named = [&](const std::string& name) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const PartKind& kind) { return kind.name == name; });
  };
  for (const std::string& name : asked)
    if (!named(name))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), "PART", "one of threads, circuit, cluster",
                                          in_quotes(name), "Name none for all of them."});
  if (!asked.empty())
    std::erase_if(kinds, [&](const PartKind& kind) { return std::count(asked.begin(), asked.end(), kind.name) == 0; });
  return kinds;
}

std::string check_text(const std::vector<Part>& parts) {
  std::string text =
      fmt::format("{:<9}{:<52}{:>12}{:>12}{:>9}{:>9}\n", "", "", "predicted", "measured", "ratio", "within");
  for (const Part& part : parts)
    for (const PredictionCheck& check : part.checks)
      text += fmt::format("{:<9}{:<52}{:>12.6g}{:>12.6g}{:>9.4f}{:>9}{}\n", part.name, check.what, check.predicted,
                          check.measured, check.ratio,
                          check.bound < 1e-9 ? "exact" : fmt::format("{:.0f} %", 100 * check.bound),
                          check.keeps() ? "" : "  off");
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
                                {"bound", check.bound},
                                {"keeps", check.keeps()}});
  return all;
}

ExitCode run_check(const Arguments& arguments) {
  ThreadsCheck threads;
  threads.particles = static_cast<std::size_t>(arguments.integer("--particles", 1000, 10'000'000));
  threads.rounds = static_cast<int>(arguments.integer("--rounds", 1, 1000));
  threads.most_threads =
      arguments.given("--threads") ? static_cast<std::size_t>(arguments.integer("--threads", 1, 4096)) : cores();
  const std::vector<PartKind> kinds = asked_for(arguments, part_kinds(threads, arguments.where()));
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  std::vector<Part> parts;
  {
    Progress progress("measurements");
    std::size_t done = 0;
    std::size_t all = 0;
    for (const PartKind& kind : kinds) all += kind.measurements;
    for (const PartKind& kind : kinds) parts.push_back({kind.name, kind.check([&] { progress.update(++done, all); })});
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

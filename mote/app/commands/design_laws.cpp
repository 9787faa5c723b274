#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"
#include "mote/design/laws.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

std::string meaning_of(const std::string& law) {
  if (law == "L1") return "one after the other";
  if (law == "L2") return "no bound on resources";
  if (law == "L3") return "R pairs";
  if (law == "L4") return "P chains, N_b + Q/P each";
  if (law == "L9") return "SISR, with its barrier";
  return std::string("case ") + static_cast<char>('A' + law[1] - '5');
}

std::string laws_text(const std::vector<design::LawErrors>& laws) {
  std::string text = fmt::format("{:<5}{:<28}{:>8}{:>12}{:>12}{:>12}{:>12}\n", "law", "of", "demands", "median, %",
                                 "19 of 20", "least", "most");
  for (const design::LawErrors& law : laws)
    text += fmt::format("{:<5}{:<28}{:>8}{:>12.3g}{:>12.3g}{:>12.3g}{:>12.3g}\n", law.law, meaning_of(law.law),
                        law.demands, 100 * law.median, 100 * law.usual, 100 * law.least, 100 * law.most);
  return text;
}

Json laws_json(const std::vector<design::LawErrors>& laws) {
  Json all = Json::object();
  for (const design::LawErrors& law : laws)
    all[law.law] = {{"of", meaning_of(law.law)}, {"demands", law.demands}, {"median", law.median},
                    {"usual", law.usual},        {"least", law.least},     {"most", law.most}};
  return all;
}

ExitCode run_laws(const Arguments& arguments) {
  const auto demands = static_cast<std::size_t>(arguments.integer("--demands", 100, 1'000'000));
  const auto seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  const std::vector<design::LawErrors> laws = design::survey_laws(demands, seed);
  if (json != nullptr) json->write(laws_json(laws).dump(2) + "\n");
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", laws_text(laws));
  return ExitCode::kDone;
}

}  // namespace

Command design_laws_command() {
  return {"design laws",
          "By how much the latency laws err, against the exact schedule",
          {},
          {{"--demands", "K", "10000",
            "demands that are drawn, from 100 to 1000000: times over six decades, Q from 10 to 1000000", "Survey"},
           {"--seed", "S", "1", "seed, an integer of at least 0", "Survey"},
           {"--json", "FILE", "", "errors as JSON; - is standard output [none]", "Output"}},
          run_laws,
          "Exit codes: 0 done, 2 wrong use, 6 cannot write."};
}

}  // namespace mote

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/bench/publication.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/particle_list.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/app/terminal/suggestion.hpp"
#include "mote/software/threads.hpp"

namespace mote {
namespace {

std::vector<std::string> task_names() {
  std::vector<std::string> names;
  for (const bench::TaskEntry& entry : bench::tasks()) names.push_back(entry.name);
  return names;
}

/// The tasks that were named, in the list's order; all when none was.
std::vector<bench::TaskEntry> tasks_from(const Arguments& arguments) {
  const auto names = task_names();
  const auto given = arguments.list("TASK");
  for (const std::string& name : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), "TASK", fmt::format("some of {}", fmt::join(names, ", ")),
                                          "\"" + name + "\"", hint(name, names, "Leave it out for all tasks.")});
  const std::set<std::string> wanted(given.begin(), given.end());
  std::vector<bench::TaskEntry> chosen;
  for (const bench::TaskEntry& entry : bench::tasks())
    if (wanted.empty() || wanted.contains(entry.name)) chosen.push_back(entry);
  return chosen;
}

std::size_t threads_from(const Arguments& arguments) {
  if (!arguments.given("--threads")) return cores();
  return static_cast<std::size_t>(arguments.integer("--threads", 1, 1024));
}

ExitCode run_bench(const Arguments& arguments) {
  const auto chosen = tasks_from(arguments);
  const std::size_t threads = threads_from(arguments);
  bench::Report report{{},
                       arguments.command_line(),
                       bench::machine_name(),
                       static_cast<std::size_t>(arguments.integer("--repeats", 1, 10'000))};
  const auto particles = particle_list_from(arguments);
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  Output* page = outputs.open(arguments.text("--report"));
  for (const bench::TaskEntry& entry : chosen) {
    Progress progress("turns of " + entry.name);
    const auto update = [&](std::size_t done, std::size_t all) { progress.update(done, all); };
    report.outcomes.push_back(
        bench::race(entry.make(entry, threads), {arguments.where(), particles, report.repeats, update, stop_flag()}));
  }
  if (json != nullptr) json->write(bench_json(report).dump(2) + "\n");
  if (page != nullptr) page->write(report::html(bench_page(report)));
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", bench_table(report));
  return ExitCode::kDone;
}

}  // namespace

Command bench_command() {
  std::string list;
  for (const bench::TaskEntry& entry : bench::tasks()) list += fmt::format("  {:<12} {}\n", entry.name, entry.meaning);
  return {"bench",
          "Check answers, then time mote and its contenders",
          {{.name = "TASK", .meaning = "tasks to run [all]", .required = false, .many = true}},
          {{"-n,--particles", "LIST", "1000,10000,100000", "numbers of particles, separated by commas", "Race"},
           {"--repeats", "R", "11", "rounds in which every contender has a turn, from 1 to 10000", "Race"},
           {"--threads", "K", "",
            "threads or ranks of the tasks threads (at most) and ranks, from 1 to 1024 [the machine's cores]", "Race"},
           {"--json", "FILE", "", "verdicts, figures and every round as JSON; - is standard output [none]", "Output"},
           {"--report", "FILE", "", "report with a plot for each task, one HTML file [none]", "Output"}},
          run_bench,
          "Tasks:\n" + list + "\nExit codes: 0 done, 1 a wrong answer, 2 wrong use, 6 cannot write, 130 interrupted."};
}

}  // namespace mote

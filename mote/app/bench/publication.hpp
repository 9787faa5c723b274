#pragma once
/// What a benchmark leaves: a table to read, JSON to compute with, a page with one plot a task.

#include <nlohmann/json_fwd.hpp>

#include "mote/app/bench/race.hpp"
#include "mote/report/page.hpp"

namespace mote::bench {

/// The tasks that were run, ready to be shown.
struct Report {
  std::vector<Outcome> outcomes;
  std::string command;  ///< makes it again
  std::string machine;  ///< see machine_name()
  std::size_t repeats;
};

/// "AMD EPYC, 2 cores": the processor as the system names it, and the cores this program may use.
std::string machine_name();

/// For each task: what it is, its figures in aligned columns, who is missing and why; then what the columns mean.
std::string bench_table(const Report& report);

/// Machine, tasks, verdicts, figures and every round; null stands for a number that is undefined.
nlohmann::json bench_json(const Report& report);

/// For each task time against the number of particles in logarithms, and the table.
report::Page bench_page(const Report& report);

}  // namespace mote::bench

#include "mote/app/reproduce/clusters.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mote/app/commands/simulate_cluster.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

double figure_of(const simulated::Sweep& sweep, const simulated::SweepRun& run, const std::string& key) {
  if (key == "seconds") return run.seconds_per_step * static_cast<double>(sweep.work.steps);
  if (key == "seconds_over_law") return run.seconds_per_step / run.law_seconds;
  if (key == "speedup_over_law") return run.speedup * run.law_seconds / sweep.runs.front().law_seconds;
  if (key == "speedup_over_most") return run.speedup / simulated::most_speedup(sweep.work, run.cast);
  return run.speedup;
}

}  // namespace

Clusters::Clusters(const Item& item) : file_(item.file) {
  for (const Run& run : item.runs) {
    std::vector<std::string> words = *item.cluster;
    words.insert(words.end(), run.options.begin(), run.options.end());
    words.emplace_back("--stage-parallel");
    const Arguments arguments = arguments_from(run.where, simulate_cluster_options(), words);
    names_.push_back(run.name);
    sweeps_.emplace(run.name, Asked{arguments, sweep_from(arguments)});
  }
  for (const Comparison& c : item.comparisons)
    for (const std::string& run : c.runs) {
      const simulated::Sweep& sweep = sweeps_.at(run).sweep;
      for (const auto& [key, count, tried] : {std::tuple{"proposers", c.cast.proposers, &sweep.proposers},
                                              std::tuple{"weighers", c.cast.weighers, &sweep.weighers}})
        if (std::find(tried->begin(), tried->end(), count) == tried->end())
          throw Refusal(ExitCode::kBadData, {c.where, fmt::format("\"{}\"", key),
                                             fmt::format("one of {}, as {} tries", fmt::join(*tried, ", "), run),
                                             std::to_string(count), ""});
    }
}

std::string Clusters::missing() const {
  try {
    simulated::check_tools("mote reproduce");
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

const simulated::Sweep& Clusters::sweep(const std::string& run, const std::function<void()>& ran) {
  Asked& asked = sweeps_.at(run);
  if (asked.sweep.runs.empty()) {
    run_sweep(asked.sweep, asked.arguments, [](std::size_t) {});
    ran();
  }
  return asked.sweep;
}

double Clusters::figure(const Comparison& c, std::size_t side, const std::function<void()>& ran) {
  const simulated::Sweep& sweep = this->sweep(c.runs[side], ran);
  for (const simulated::SweepRun& run : sweep.runs)
    if (run.cast.proposers == c.cast.proposers && run.cast.weighers == c.cast.weighers)
      return figure_of(sweep, run, c.key);
  return kNaN;
}

std::vector<std::pair<std::string, simulated::Sweep>> Clusters::sweeps(const std::function<void()>& ran) {
  std::vector<std::pair<std::string, simulated::Sweep>> all;
  for (const std::string& name : names_) all.emplace_back(name, sweep(name, ran));
  return all;
}

}  // namespace mote::reproduce

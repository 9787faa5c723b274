#pragma once
/// The publication of a sweep: table, JSON and page.

#include <nlohmann/json_fwd.hpp>

#include "mote/app/simulated/sweep.hpp"
#include "mote/report/page.hpp"

namespace mote::simulated {

/// Another filter on the same ranks and network, for comparison.
struct Rival {
  std::string name;
  Workload work;
  std::vector<std::size_t> ranks;
  std::vector<SweepRun> runs = {};
};

/// A sweep with its results.
struct Sweep {
  std::string command, model, where_from;  ///< where_from: what the times are
  Platform platform;
  Workload work;
  std::vector<std::size_t> ranks = {}, proposers = {}, weighers = {};  ///< to be tried
  std::vector<SweepRun> runs;
  std::vector<Rival> rivals = {};
};

/// The times of a particle, in words.
std::string times_of(const Workload& work);

/// What is simulated, in a few words: the filter, or how its groups exchange.
std::string name_of_work(const Workload& work);

nlohmann::json sweep_json(const Sweep& sweep);

/// The runs as lines for a terminal.
std::string sweep_table(const Sweep& sweep);

report::Page sweep_page(const Sweep& sweep);

}  // namespace mote::simulated

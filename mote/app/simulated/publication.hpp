#pragma once
/// The publication of a sweep: table, JSON and page.

#include <nlohmann/json_fwd.hpp>

#include "mote/app/simulated/sweep.hpp"
#include "mote/report/page.hpp"

namespace mote::simulated {

/// A sweep with its results.
struct Sweep {
  std::string command, model, where_from;  ///< where_from: what the times are
  Platform platform;
  Workload work;
  std::vector<std::size_t> ranks = {}, proposers = {}, weighers = {};  ///< to be tried
  std::vector<SweepRun> runs;
};

nlohmann::json sweep_json(const Sweep& sweep);

/// The runs as lines for a terminal.
std::string sweep_table(const Sweep& sweep);

report::Page sweep_page(const Sweep& sweep);

}  // namespace mote::simulated

#include "mote/app/simulated/charts.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>

namespace mote::simulated {
namespace {

using report::Chart;
using report::Series;

/// A line for each number of proposers, along the weighers, or the other way round where there are more of those.
std::vector<Series> lines_of(const Sweep& sweep, const std::function<double(const SweepRun&)>& figure) {
  std::size_t most_proposers = 0;
  std::size_t most_weighers = 0;
  for (const SweepRun& run : sweep.runs) {
    most_proposers = std::max(most_proposers, run.cast.proposers);
    most_weighers = std::max(most_weighers, run.cast.weighers);
  }
  const bool along_weighers = most_weighers >= most_proposers;
  std::map<std::size_t, Series> lines;
  for (const SweepRun& run : sweep.runs) {
    const std::size_t fixed = along_weighers ? run.cast.proposers : run.cast.weighers;
    Series& line = lines[fixed];
    line.name = fmt::format("{} = {}", along_weighers ? "R_p" : "R_w", fixed);
    line.mark = Series::Mark::kMarkedLine;
    line.x.push_back(static_cast<double>(along_weighers ? run.cast.weighers : run.cast.proposers));
    line.y.push_back(figure(run));
  }
  std::vector<Series> all;
  for (auto& [fixed, line] : lines) all.push_back(std::move(line));
  return all;
}

std::vector<Chart> stage_charts(const Sweep& sweep) {
  const auto most = [&](std::size_t Cast::*part) {
    std::size_t count = 0;
    for (const SweepRun& run : sweep.runs) count = std::max(count, run.cast.*part);
    return count;
  };
  const std::string label = most(&Cast::weighers) >= most(&Cast::proposers) ? "weighers R_w" : "proposers R_p";
  Chart time{.title = "Time of a step", .x_label = label, .y_label = "ms"};
  time.series = lines_of(sweep, [](const SweepRun& run) { return run.seconds_per_step * 1e3; });
  for (Series& law : lines_of(sweep, [](const SweepRun& run) { return run.law_seconds * 1e3; })) {
    law.name += ", latency law";
    law.mark = Series::Mark::kLine;
    time.series.push_back(std::move(law));
  }
  Chart speedup{.title = "Speed-up", .x_label = label, .y_label = "times the first setting"};
  speedup.series = lines_of(sweep, [](const SweepRun& run) { return run.speedup; });
  return {time, speedup};
}

/// A line of a figure over the ranks.
Series line_of(const std::string& name, const std::vector<SweepRun>& runs,
               const std::function<double(const SweepRun&)>& figure) {
  Series series{.name = name, .mark = Series::Mark::kMarkedLine};
  for (const SweepRun& run : runs) {
    series.x.push_back(static_cast<double>(run.ranks));
    series.y.push_back(figure(run));
  }
  return series;
}

std::vector<Chart> share_charts(const Sweep& sweep) {
  const auto lines = [&](const std::function<double(const SweepRun&)>& figure) {
    std::vector<Series> all{line_of(sweep.rivals.empty() ? "simulated" : name_of_work(sweep.work), sweep.runs, figure)};
    for (const Rival& rival : sweep.rivals) all.push_back(line_of(rival.name, rival.runs, figure));
    return all;
  };
  const auto over_ranks = [](const std::string& title, const std::string& label, std::vector<Series> series) {
    return Chart{.title = title, .x_label = "ranks", .y_label = label, .series = std::move(series), .log_x = true};
  };
  Chart speedup = over_ranks("Speed-up", "times one rank", lines([](const SweepRun& run) { return run.speedup; }));
  speedup.series.push_back(
      line_of("as many as ranks", sweep.runs, [](const SweepRun& run) { return static_cast<double>(run.ranks); }));
  speedup.series.back().mark = Series::Mark::kLine;
  speedup.log_y = true;
  std::vector<Chart> charts{
      std::move(speedup),
      over_ranks("Efficiency", "%", lines([](const SweepRun& run) { return run.efficiency * 100; }))};
  if (sweep.rivals.empty()) return charts;
  charts.push_back(
      over_ranks("Time of a step", "ms", lines([](const SweepRun& run) { return run.seconds_per_step * 1e3; })));
  charts.push_back(
      over_ranks("Bytes sent", "bytes a step", lines([](const SweepRun& run) { return run.bytes_per_step; })));
  return charts;
}

}  // namespace

std::vector<Chart> charts_of(const Sweep& sweep) {
  return sweep.work.by_stages ? stage_charts(sweep) : share_charts(sweep);
}

}  // namespace mote::simulated

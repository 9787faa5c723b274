#include "mote/app/simulated/publication.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mote::simulated {
namespace {

using report::Chart;
using report::Series;

std::string parallel(const Workload& work) {
  if (work.by_stages) return "stage-parallel";
  return work.weak ? "data-parallel, weak scaling" : "data-parallel, strong scaling";
}

std::string times_of(const Workload& work) {
  if (!work.by_stages) return fmt::format("{:.4g} ns a particle and step", seconds_per_particle(work) * 1e9);
  return fmt::format("T_p = {:.4g} us, T_w = {:.4g} us, T_d = {:.4g} us", work.times.propose * 1e6,
                     work.times.weigh * 1e6, work.times.chain * 1e6);
}

std::vector<std::string> columns(const Workload& work) {
  if (work.by_stages) return {"ranks", "R_p", "R_w", "ms a step", "law, ms", "speed-up", "at work, %"};
  return {"ranks", "particles", "ms a step", "speed-up", "efficiency, %"};
}

std::vector<std::string> cells(const Workload& work, const SweepRun& run) {
  const std::string ms = fmt::format("{:.6g}", run.seconds_per_step * 1e3);
  const std::string speedup = fmt::format("{:.4g}", run.speedup);
  const std::string percent = fmt::format("{:.2f}", run.efficiency * 100);
  if (!work.by_stages) return {std::to_string(run.ranks), std::to_string(run.particles), ms, speedup, percent};
  return {std::to_string(run.ranks),
          std::to_string(run.cast.proposers),
          std::to_string(run.cast.weighers),
          ms,
          fmt::format("{:.6g}", run.law_seconds * 1e3),
          speedup,
          percent};
}

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

std::vector<Chart> share_charts(const Sweep& sweep) {
  Series speedup{.name = "simulated", .mark = Series::Mark::kMarkedLine};
  Series efficiency = speedup;
  Series all{.name = "as many as ranks"};
  for (const SweepRun& run : sweep.runs) {
    const auto ranks = static_cast<double>(run.ranks);
    for (Series* series : {&speedup, &efficiency, &all}) series->x.push_back(ranks);
    speedup.y.push_back(run.speedup);
    efficiency.y.push_back(run.efficiency * 100);
    all.y.push_back(ranks);
  }
  return {{.title = "Speed-up",
           .x_label = "ranks",
           .y_label = "times one rank",
           .series = {speedup, all},
           .log_x = true,
           .log_y = true},
          {.title = "Efficiency", .x_label = "ranks", .y_label = "%", .series = {efficiency}, .log_x = true}};
}

std::string summary_of(const Sweep& sweep) {
  const SweepRun& last = sweep.runs.back();
  const std::string opening = fmt::format("{} on {}, {}", sweep.model, sweep.platform.name, parallel(sweep.work));
  if (sweep.work.by_stages)
    return fmt::format(
        "{}: {} proposer{} and {} weigher{} take {:.4g} ms for a step of {} particles, {:.4g} times as fast as the "
        "first setting.",
        opening, last.cast.proposers, last.cast.proposers == 1 ? "" : "s", last.cast.weighers,
        last.cast.weighers == 1 ? "" : "s", last.seconds_per_step * 1e3, last.particles, last.speedup);
  return fmt::format("{}: {} ranks reach {:.4g} times one, {:.1f} % of what they could.", opening, last.ranks,
                     last.speedup, last.efficiency * 100);
}

}  // namespace

nlohmann::json sweep_json(const Sweep& sweep) {
  const Platform& platform = sweep.platform;
  const Workload& work = sweep.work;
  nlohmann::json runs = nlohmann::json::array();
  for (const SweepRun& run : sweep.runs) {
    nlohmann::json entry{{"ranks", run.ranks},
                         {"particles", run.particles},
                         {"seconds_per_step", run.seconds_per_step},
                         {"speedup", run.speedup},
                         {"efficiency", run.efficiency}};
    if (work.by_stages) {
      entry["proposers"] = run.cast.proposers;
      entry["weighers"] = run.cast.weighers;
      entry["chains"] = run.cast.chains;
      entry["law_seconds"] = run.law_seconds;
    }
    runs.push_back(std::move(entry));
  }
  nlohmann::json network{{"name", platform.name}, {"meaning", platform.meaning}};
  if (platform.hosts > 0) {
    network["hosts"] = platform.hosts;
    network["latency_s"] = platform.latency_s;
    network["bandwidth_bytes_per_s"] = platform.bandwidth;
  }
  nlohmann::json json{{"platform", std::move(network)},
                      {"message_model", kMessageModel},
                      {"model", sweep.model},
                      {"filter", name_of(work.filter)},
                      {"parallel", work.by_stages ? "stages" : "data"},
                      {"times", sweep.where_from},
                      {"steps", work.steps},
                      {"runs", std::move(runs)}};
  if (work.by_stages) {
    json["tp"] = work.times.propose;
    json["tw"] = work.times.weigh;
    json["td"] = work.times.chain;
    json["step_bytes"] = work.step_bytes;
  } else {
    json["scaling"] = work.weak ? "weak" : "strong";
    json["seconds_per_particle"] = seconds_per_particle(work);
    json["ess_share"] = work.ess_share;
  }
  return json;
}

std::string sweep_table(const Sweep& sweep) {
  std::string text = fmt::format("{}  {}  {}  {}\n{}, {}\n", sweep.model, name_of(sweep.work.filter),
                                 parallel(sweep.work), sweep.platform.name, times_of(sweep.work), sweep.where_from);
  const auto line = [&](const std::vector<std::string>& row) {
    for (const std::string& cell : row) text += fmt::format("{:>14}", cell);
    text += '\n';
  };
  line(columns(sweep.work));
  for (const SweepRun& run : sweep.runs) line(cells(sweep.work, run));
  return text;
}

report::Page sweep_page(const Sweep& sweep) {
  const Workload& work = sweep.work;
  report::Page page{
      .title = "A simulated cluster: " + sweep.platform.name, .summary = summary_of(sweep), .command = sweep.command};
  page.facts = {{"Platform", sweep.platform.meaning},
                {"Times", times_of(work) + ", " + sweep.where_from},
                {"Particles", fmt::format("{} {}", work.particles, work.weak && !work.by_stages ? "a rank" : "in all")},
                {"Steps", std::to_string(work.steps)}};
  if (!work.by_stages) page.facts.push_back({"ESS", fmt::format("{:.3g} N", work.ess_share)});
  if (work.step_bytes > 0) page.facts.push_back({"Bytes to all in a step", std::to_string(work.step_bytes)});
  if (sweep.platform.hosts > 0)
    page.facts.push_back({"Network", fmt::format("{:.4g} us, {:.4g} MB/s", sweep.platform.latency_s * 1e6,
                                                 sweep.platform.bandwidth * 1e-6)});
  page.charts = work.by_stages ? stage_charts(sweep) : share_charts(sweep);
  report::Table table{.title = "Runs", .columns = columns(work)};
  for (const SweepRun& run : sweep.runs) table.rows.push_back(cells(work, run));
  page.tables = {table};
  page.notes = {"Ranks exchange the messages of mote run --engine mpi; particles are not there, their time is told.",
                kMessageModel};
  return page;
}

}  // namespace mote::simulated

#include "mote/app/simulated/publication.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/simulated/charts.hpp"

namespace mote::simulated {
namespace {

std::string parallel(const Workload& work) {
  if (work.by_stages) return "stage-parallel";
  return work.weak ? "data-parallel, weak scaling" : "data-parallel, strong scaling";
}

std::string exchange_of(const GroupOptions& groups) {
  if (!groups.exchanges_before()) return "no exchange";
  constexpr std::array<const char*, 4> kHow{"none", "append", "replace", "swap"};
  constexpr std::array<const char*, 4> kWhere{"ring", "bidirectional", "torus", "hypercube"};
  const std::string often = groups.exchange_every == 1 ? "" : fmt::format(" every {} steps", groups.exchange_every);
  return fmt::format("{} {} on {}{}", kHow[static_cast<std::size_t>(groups.exchange)], groups.exchange_count,
                     kWhere[static_cast<std::size_t>(groups.topology)], often);
}

/// From host to host; of a ring, of a hop.
double latency_of(const Platform& platform) { return platform.link_latency_s * (platform.ring ? 1 : 2); }

std::vector<std::string> columns(const Workload& work) {
  if (work.by_stages)
    return {"ranks", "R_p", "R_w", "ms a step", "predicted, ms", "law, ms", "speed-up", "at work, %", "bytes a step"};
  std::vector<std::string> all{"ranks",    "particles",     "ms a step",   "predicted, ms",
                               "speed-up", "efficiency, %", "bytes a step"};
  if (work.filter == FilterKind::kDistributed) all.insert(all.begin() + 1, "groups");
  return all;
}

std::vector<std::string> cells(const Workload& work, const SweepRun& run) {
  const std::string ms = fmt::format("{:.6g}", run.seconds_per_step * 1e3);
  const std::string predicted = run.predicted_seconds ? fmt::format("{:.6g}", *run.predicted_seconds * 1e3) : "-";
  const std::string speedup = fmt::format("{:.4g}", run.speedup);
  const std::string percent = fmt::format("{:.2f}", run.efficiency * 100);
  const std::string bytes = fmt::format("{:.0f}", run.bytes_per_step);
  if (!work.by_stages) {
    std::vector<std::string> all{
        std::to_string(run.ranks), std::to_string(run.particles), ms, predicted, speedup, percent, bytes};
    if (work.filter == FilterKind::kDistributed) all.insert(all.begin() + 1, std::to_string(work.groups_of(run.ranks)));
    return all;
  }
  return {std::to_string(run.ranks),
          std::to_string(run.cast.proposers),
          std::to_string(run.cast.weighers),
          ms,
          predicted,
          fmt::format("{:.6g}", run.law_seconds * 1e3),
          speedup,
          percent,
          bytes};
}

/// How a sweep's last setting compares with its rivals'.
std::string compared(const Sweep& sweep) {
  std::string text;
  const SweepRun& last = sweep.runs.back();
  for (const Rival& rival : sweep.rivals)
    if (!rival.runs.empty() && rival.runs.back().ranks == last.ranks)
      text += fmt::format(" {} takes {:.4g} times as long and {:.4g} times the bytes.", rival.name,
                          rival.runs.back().seconds_per_step / last.seconds_per_step,
                          rival.runs.back().bytes_per_step / last.bytes_per_step);
  return text;
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
  return fmt::format("{}{}: {} ranks reach {:.4g} times one, {:.1f} % of what they could.{}", opening,
                     sweep.rivals.empty() ? "" : ", " + name_of_work(sweep.work), last.ranks, last.speedup,
                     last.efficiency * 100, compared(sweep));
}

nlohmann::json runs_json(const Workload& work, const std::vector<SweepRun>& runs) {
  nlohmann::json list = nlohmann::json::array();
  for (const SweepRun& run : runs) {
    nlohmann::json entry{
        {"ranks", run.ranks},
        {"particles", run.particles},
        {"seconds_per_step", run.seconds_per_step},
        {"messages_per_step", run.messages_per_step},
        {"bytes_per_step", run.bytes_per_step},
        {"predicted_seconds", run.predicted_seconds ? nlohmann::json(*run.predicted_seconds) : nlohmann::json(nullptr)},
        {"speedup", run.speedup},
        {"efficiency", run.efficiency}};
    if (work.filter == FilterKind::kDistributed) entry["groups"] = work.groups_of(run.ranks);
    if (work.by_stages) {
      entry["proposers"] = run.cast.proposers;
      entry["weighers"] = run.cast.weighers;
      entry["chains"] = run.cast.chains;
      entry["law_seconds"] = run.law_seconds;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

/// What is simulated besides the particles' number.
void add_work(const Workload& work, nlohmann::json& json) {
  json["tp"] = work.times.propose;
  json["tw"] = work.times.weigh;
  json["td"] = work.times.chain;
  if (work.by_stages) {
    json["step_bytes"] = work.step_bytes;
    return;
  }
  json["scaling"] = work.weak ? "weak" : "strong";
  json["seconds_per_particle"] = seconds_per_particle(work);
  if (work.filter == FilterKind::kSisr) json["ess_share"] = work.ess_share;
  if (work.filter == FilterKind::kDistributed) json["exchange"] = exchange_of(work.groups);
  if (work.filter == FilterKind::kImh || work.filter == FilterKind::kAuxiliary) json["chains"] = work.chains;
}

}  // namespace

std::string times_of(const Workload& work) {
  if (!work.by_stages) return fmt::format("{:.4g} ns a particle and step", seconds_per_particle(work) * 1e9);
  return fmt::format("T_p = {:.4g} us, T_w = {:.4g} us, T_d = {:.4g} us", work.times.propose * 1e6,
                     work.times.weigh * 1e6, work.times.chain * 1e6);
}

std::string name_of_work(const Workload& work) {
  return work.filter == FilterKind::kDistributed ? exchange_of(work.groups) : std::string(name_of(work.filter));
}

nlohmann::json sweep_json(const Sweep& sweep) {
  const Platform& platform = sweep.platform;
  const Workload& work = sweep.work;
  nlohmann::json network{{"name", platform.name}, {"meaning", platform.meaning}};
  if (platform.hosts > 0) {
    network["hosts"] = platform.hosts;
    network["latency_s"] = latency_of(platform);
    network["bandwidth_bytes_per_s"] = platform.bandwidth;
  }
  nlohmann::json json{{"platform", std::move(network)},
                      {"message_model", kMessageModel},
                      {"model", sweep.model},
                      {"filter", name_of(work.filter)},
                      {"parallel", work.by_stages ? "stages" : "data"},
                      {"times", sweep.where_from},
                      {"steps", work.steps},
                      {"runs", runs_json(work, sweep.runs)}};
  add_work(work, json);
  for (const Rival& rival : sweep.rivals)
    json["beside"].push_back(
        {{"name", rival.name}, {"filter", name_of(rival.work.filter)}, {"runs", runs_json(rival.work, rival.runs)}});
  return json;
}

std::string sweep_table(const Sweep& sweep) {
  std::string text = fmt::format("{}  {}  {}  {}\n{}, {}\n", sweep.model, name_of(sweep.work.filter),
                                 parallel(sweep.work), sweep.platform.name, times_of(sweep.work), sweep.where_from);
  const auto line = [&](const std::vector<std::string>& row) {
    for (const std::string& cell : row) text += fmt::format("{:>14}", cell);
    text += '\n';
  };
  const auto table = [&](const Workload& work, const std::vector<SweepRun>& runs) {
    line(columns(work));
    for (const SweepRun& run : runs) line(cells(work, run));
  };
  if (!sweep.rivals.empty()) text += name_of_work(sweep.work) + "\n";
  table(sweep.work, sweep.runs);
  for (const Rival& rival : sweep.rivals) {
    text += rival.name + "\n";
    table(rival.work, rival.runs);
  }
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
  if (!work.by_stages && (work.filter == FilterKind::kSisr || !sweep.rivals.empty()))
    page.facts.push_back({"ESS", fmt::format("{:.3g} N", work.ess_share)});
  if (!work.by_stages && work.filter != FilterKind::kSisr && sweep.rivals.empty())
    page.facts.push_back({"Chains", std::to_string(work.chains)});
  if (work.step_bytes > 0) page.facts.push_back({"Bytes to all in a step", std::to_string(work.step_bytes)});
  if (sweep.platform.hosts > 0)
    page.facts.push_back({"Network", fmt::format("{:.4g} us, {:.4g} MB/s", latency_of(sweep.platform) * 1e6,
                                                 sweep.platform.bandwidth * 1e-6)});
  page.charts = charts_of(sweep);
  const auto add_table = [&](const std::string& title, const Workload& of, const std::vector<SweepRun>& runs) {
    report::Table& table = page.tables.emplace_back(report::Table{.title = title, .columns = columns(of)});
    for (const SweepRun& run : runs) table.rows.push_back(cells(of, run));
  };
  add_table(sweep.rivals.empty() ? "Runs" : name_of_work(work), work, sweep.runs);
  for (const Rival& rival : sweep.rivals) add_table(rival.name, rival.work, rival.runs);
  page.notes = {
      "Ranks exchange the messages of mote run --engine mpi; particles are not there, their time is told.",
      kMessageModel,
      "Bytes a step: of all ranks; what a rank tells all goes once to each of them, and sums by doubled distances."};
  if (!sweep.rivals.empty() && sweep.rivals.back().ranks != sweep.ranks)
    page.notes.emplace_back(
        "sisr has whole blocks of 1024 particles on every rank; more ranks than those it cannot use.");
  return page;
}

}  // namespace mote::simulated

#include "mote/app/simulated/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/hand_over.hpp"
#include "mote/app/simulated/prediction.hpp"
#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/software/pipeline/rank_stages.hpp"

namespace mote::simulated {
namespace {

constexpr const char* kRanks = "mote-smpi";

/// Where a platform lies while it is simulated.
class Stage {
 public:
  explicit Stage(const Platform& platform) : platform_(folder_.file("platform.xml")) {
    if (!platform.file.empty()) {
      platform_ = platform.file;
      return;
    }
    hosts_ = folder_.file("hosts");
    std::ofstream(platform_) << platform.xml;
    std::ofstream(hosts_) << host_list(platform);
  }

  std::vector<std::string> words(std::size_t ranks) const {
    std::vector<std::string> all{"-np", std::to_string(ranks), "-platform", platform_, "-no-privatize"};
    if (!hosts_.empty()) all.insert(all.end(), {"-hostfile", hosts_});
    // computing takes the time that it is told to take, not this machine's; trees for collective operations
    for (const char* option :
         {"network/model:CM02", "smpi/simulate-computation:no", "smpi/coll-selector:mpich", "smpi/test:0"})
      all.push_back(fmt::format("--cfg={}", option));
    all.emplace_back("--log=root.thres:critical");
    return all;
  }

 private:
  ScratchFolder folder_;
  std::string platform_, hosts_;
};

Refusal failed(const std::string& where, const std::string& what, const std::string& expected, const std::string& got,
               const std::string& next) {
  return {ExitCode::kOutsideTool, {where, what, expected, got, next}};
}

std::string last_lines(const std::string& text) {
  std::string line = text.substr(0, text.find_last_not_of(" \n") + 1);
  if (const std::size_t at = line.rfind('\n'); at != std::string::npos) line = line.substr(at + 1);
  return line.empty() ? "nothing" : line;
}

/// Runs a setting; what a step took is noted in it.
void simulate(const Stage& stage, const std::vector<std::string>& scenario, SweepRun& run, const std::string& where) {
  std::vector<std::string> words = stage.words(run.ranks);
  words.push_back(beside(kRanks));
  words.insert(words.end(), scenario.begin(), scenario.end());
  const OutsideEnd end = run_outside("smpirun", words);
  const auto json = nlohmann::json::parse(end.out, nullptr, false);
  if (end.code != 0 || !json.is_object())
    throw failed(where, "smpirun", fmt::format("a simulation of {} ranks", run.ranks),
                 fmt::format("exit code {} and \"{}\"", end.code, last_lines(end.err)),
                 "Check the platform, and that there is memory for the ranks.");
  run.seconds_per_step = json.at("seconds_per_step").get<double>();
  run.messages_per_step = json.at("messages_per_step").get<double>();
  run.bytes_per_step = json.at("bytes_per_step").get<double>();
}

/// A scenario's name and the words that all have.
std::vector<std::string> scenario(const std::string& name, const Workload& work, std::size_t particles) {
  return {name,
          fmt::format("particles={}", particles),
          fmt::format("dimensions={}", work.dimensions),
          fmt::format("angles={}", work.angles),
          fmt::format("number-bytes={}", work.number_bytes),
          fmt::format("tp={}", work.times.propose),
          fmt::format("tw={}", work.times.weigh),
          fmt::format("td={}", work.times.chain),
          fmt::format("steps={}", work.steps)};
}

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::string> data_parallel_scenario(const Workload& work, std::size_t ranks) {
  const std::size_t particles = work.particles_of(ranks);
  if (work.filter == FilterKind::kSisr)
    return with(scenario("particles", work, particles),
                {fmt::format("variation={}", std::sqrt(std::max(0.0, 1 / work.ess_share - 1))),
                 fmt::format("seed={}", work.seed)});
  if (work.filter == FilterKind::kDistributed)
    return with(scenario("groups", work, particles),
                {fmt::format("groups={}", work.groups_of(ranks)),
                 fmt::format("exchange={}", static_cast<int>(work.groups.exchange)),
                 fmt::format("exchange-count={}", work.groups.exchange_count),
                 fmt::format("exchange-every={}", work.groups.exchange_every),
                 fmt::format("topology={}", static_cast<int>(work.groups.topology))});
  return with(scenario("chains", work, particles),
              {fmt::format("chains={}", work.chains), fmt::format("weighted-start={}", work.weighted_start ? 1 : 0)});
}

std::vector<std::string> stage_parallel_scenario(const Workload& work, const Cast& cast) {
  const bool resamples = work.filter == FilterKind::kSisr;
  const std::size_t state = work.dimensions * work.number_bytes;
  return with(scenario("stages", work, work.particles),
              {fmt::format("proposers={}", cast.proposers), fmt::format("weighers={}", cast.weighers),
               fmt::format("chains={}", cast.chains), fmt::format("resamples={}", resamples ? 1 : 0),
               // states and log weights; what the chain decides by
               fmt::format("particle-bytes={}", state + (resamples ? 8 : 16)),
               fmt::format("set-bytes={}", work.particles * (state + (resamples ? 8 : 0))),
               fmt::format("step-bytes={}", work.step_bytes), fmt::format("block={}", work.block)});
}

}  // namespace

const std::string kMessageModel =
    "A message takes the latency of its way and its bytes over the bandwidth; messages that share a link at a time "
    "share its "
    "bandwidth evenly (SimGrid's model CM02, both directions apart). A message of up to 64 KiB leaves its sender at "
    "once, a larger "
    "one when its receiver waits for it. Sending and receiving take a processor no time. Ranks have no noise: "
    "all take the same time for the same work. Collective operations go by trees or doubled distances, log2 R rounds "
    "(SMPI's "
    "selection \"mpich\").";

void check_tools(const std::string& where) {
  std::error_code error;
  if (!std::filesystem::exists(beside(kRanks), error))
    throw failed(where, kRanks, "the ranks of simulated clusters, beside mote", "no such file",
                 "Install SimGrid (Debian: libsimgrid-dev) and build mote again.");
  if (const OutsideEnd end = run_outside("smpirun", {"-version"}); end.error != 0)
    throw failed(where, "smpirun", "SimGrid's smpirun in the PATH", std::strerror(end.error),
                 "Install SimGrid (Debian: libsimgrid-dev).");
}

std::vector<SweepRun> data_parallel_sweep(const Platform& platform, const Workload& work,
                                          const std::vector<std::size_t>& ranks, const std::string& where,
                                          const SweepProgress& progress) {
  const Stage stage(platform);
  std::vector<SweepRun> runs;
  for (const std::size_t r : ranks) {
    SweepRun run{.ranks = r, .particles = work.particles_of(r)};
    run.predicted_seconds = predicted_on_shares(platform, work, r);
    simulate(stage, data_parallel_scenario(work, r), run, where);
    const double alone = (runs.empty() ? run : runs.front()).seconds_per_step;
    const auto count = static_cast<double>(r);
    run.efficiency = alone / run.seconds_per_step / (work.weak ? 1 : count);
    run.speedup = run.efficiency * count;
    runs.push_back(run);
    progress();
  }
  return runs;
}

double law_of(const Workload& work, const Cast& cast) {
  const auto n = static_cast<double>(work.particles);
  const auto block = static_cast<double>(work.block != 0 ? work.block : message_block(work.particles, cast));
  const StageTimes times{work.times.propose * block, work.times.weigh * block, work.times.chain * block};
  const auto chains = static_cast<double>(cast.chains);
  const double proposers = static_cast<double>(cast.proposers) / chains;
  const double weighers = static_cast<double>(cast.weighers) / chains;
  const double blocks = n / chains / block;
  return work.filter == FilterKind::kSisr ? barrier_time(blocks, times, proposers, weighers, work.times.chain * n)
                                          : single_chain_time(blocks, times, proposers, weighers);
}

double most_speedup(const Workload& work, const Cast& cast) {
  const double others = std::max(work.times.weigh / static_cast<double>(cast.weighers),
                                 work.times.chain / static_cast<double>(cast.chains));
  return std::max(work.times.propose, others) /
         std::max(work.times.propose / static_cast<double>(cast.proposers), others);
}

std::vector<SweepRun> stage_parallel_sweep(const Platform& platform, const Workload& work,
                                           const std::vector<std::size_t>& proposers,
                                           const std::vector<std::size_t>& weighers, const std::string& where,
                                           const SweepProgress& progress) {
  const Stage stage(platform);
  std::vector<SweepRun> runs;
  for (const std::size_t rp : proposers)
    for (const std::size_t rw : weighers) {
      SweepRun run{.particles = work.particles, .cast = {rp, rw, work.chains}};
      run.ranks = run.cast.ranks();
      run.law_seconds = law_of(work, run.cast);
      run.predicted_seconds = predicted_by_stages(platform, work, run.cast);
      simulate(stage, stage_parallel_scenario(work, run.cast), run, where);
      run.speedup = (runs.empty() ? run : runs.front()).seconds_per_step / run.seconds_per_step;
      run.efficiency = static_cast<double>(work.particles) * seconds_per_particle(work) /
                       (static_cast<double>(run.ranks) * run.seconds_per_step);
      runs.push_back(run);
      progress();
    }
  return runs;
}

}  // namespace mote::simulated

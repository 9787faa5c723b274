#include "mote/app/commands/simulate_cluster.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/cluster_work.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/simulated/measurement.hpp"
#include "mote/app/terminal/progress.hpp"

namespace mote {
namespace {

using namespace simulated;

/// Times and weights as given, or measured.
std::string find_times(const CatalogueModel& model, const Arguments& arguments, Workload& work) {
  const auto seconds = [&](const char* option) {
    return arguments.given(option) ? arguments.number(option, 0, 1e6) : 0.0;
  };
  const bool given = arguments.given("--tp") || arguments.given("--tw") || arguments.given("--td");
  const bool weights_matter =
      !work.by_stages && (work.filter == FilterKind::kSisr || work.filter == FilterKind::kDistributed);
  const bool weights = arguments.given("--ess") || !weights_matter;
  if (arguments.given("--ess")) work.ess_share = arguments.number("--ess", 1e-9, 1);
  if (!given || !weights) {
    const Measurement measurement = measured(model, work, arguments.text("--proposal"), arguments.where());
    const double slower = arguments.number("--slower", 1e-6, 1e6);
    work.times = {measurement.times.propose * slower, measurement.times.weigh * slower,
                  measurement.times.chain * slower};
    if (!weights) work.ess_share = measurement.ess_share;
  }
  if (!given)
    return "measured on one core of this machine" +
           (arguments.given("--slower") ? fmt::format(", times {}", arguments.text("--slower")) : "");
  work.times = {seconds("--tp"), seconds("--tw"), seconds("--td")};
  return "as given";
}

/// What a distributed filter is held against on the same network: groups that tell each other nothing but sums, and
/// selection over all particles.
std::vector<Rival> rivals_of(const Sweep& sweep) {
  if (sweep.work.filter != FilterKind::kDistributed) return {};
  std::vector<Rival> rivals;
  if (sweep.work.groups.exchanges_before()) {
    Rival& local = rivals.emplace_back(Rival{"no exchange", sweep.work, sweep.ranks});
    local.work.groups.exchange = Exchange::kNone;
  }
  Rival& global = rivals.emplace_back(Rival{"global resampling (sisr)", sweep.work, sweep.ranks});
  global.work.filter = FilterKind::kSisr;
  global.ranks = ranks_with_blocks(sweep.work, sweep.ranks);
  return rivals;
}

std::unique_ptr<CatalogueModel> model_from(const Arguments& arguments, const std::string& name) {
  return find_model(name, arguments.where()).make(Settings(arguments.where(), arguments.list("--set")), {});
}

std::vector<OptionSpec> share_options() {
  const std::string shares = "Data-parallel: ranks share the particles";
  return {{"--data-parallel", "", "", "ranks share the particles (the default)", shares},
          {"--ranks", "LIST", "1,2,4,8,16", "numbers of ranks, separated by commas", shares},
          {"--weak", "", "", "N particles on every rank (the default)", shares},
          {"--strong", "", "", "N particles on all ranks together", shares},
          {"--ess", "X", "", "sisr: effective sample size over N, how far children travel [measured]", shares},
          {"--chain-start", "HOW", "first", "chains: first proposal, or weighted = all are told all weights", shares}};
}

/// Those of the exchange as `mote run` has them.
std::vector<OptionSpec> group_options() {
  const std::string groups = "Groups (distributed, which is held against sisr)";
  std::vector<OptionSpec> all{{"--groups", "K", "", "groups in all, whole ones on a rank [one a rank]", groups}};
  for (OptionSpec& option : plan_options())
    if (std::find(kExchangeOptions.begin(), kExchangeOptions.end(), option.flags) != kExchangeOptions.end()) {
      option.group = groups;
      all.push_back(std::move(option));
    }
  return all;
}

std::vector<OptionSpec> stage_options() {
  const std::string stages = "Stage-parallel: ranks propose, weigh, run chains";
  return {{"--stage-parallel", "", "", "ranks have the stages of a step", stages},
          {"--proposers", "LIST", "1", "numbers of ranks that propose, each from 1 to 64", stages},
          {"--weighers", "LIST", "1", "numbers of ranks that weigh, likewise", stages},
          {"--block", "B", "", "particles in a message [as mote run: 16 to 1024, by N]", stages},
          {"--step-bytes", "B", "0", "bytes that rank 0 hands to all in every step besides: a frame of video", stages}};
}

std::vector<OptionSpec> work_options() {
  const std::string work = "Work";
  return {{"--filter", "NAME", "sisr", "sisr, imh, auxiliary; data-parallel also distributed", work},
          {"-n,--particles", "N", "1000000", "particles", work},
          {"--chains", "P", "", "chains (imh, auxiliary) in all [16 a rank of the most; stage-parallel 1, a rank each]",
           work},
          {"--tp", "S", "", "seconds that a host takes to propose a particle [measured, on one core of this machine]",
           work},
          {"--tw", "S", "", "seconds to weigh it [measured; 0 beside another of the three]", work},
          {"--td", "S", "", "seconds for the chain to decide on it, or to resample [likewise]", work},
          {"--slower", "X", "1", "times as long as measured that a host takes", work},
          {"--proposal", "NAME", "prior", "proposal that is measured (see mote models NAME)", work},
          {"--precision", "TYPE", "double", "float or double", work},
          {"--dimensions", "D", "", "components of a state [the model's]", work},
          {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", work, true},
          {"--steps", "T", "10", "steps that are simulated, after a first one", work},
          {"--seed", "S", "1", "seed of recording and weights", work}};
}

ExitCode run_simulate_cluster(const Arguments& arguments) {
  Sweep sweep = sweep_from(arguments);
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  Output* page = outputs.open(arguments.text("--report"));
  {
    Progress progress("clusters");
    std::size_t done = 0;
    run_sweep(sweep, arguments, [&](std::size_t all) { progress.update(++done, all); });
  }
  if (json != nullptr) json->write(sweep_json(sweep).dump(2) + "\n");
  if (page != nullptr) page->write(report::html(sweep_page(sweep)));
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", sweep_table(sweep));
  return ExitCode::kDone;
}

}  // namespace

simulated::Sweep sweep_from(const Arguments& arguments) {
  Sweep sweep;
  sweep.command = arguments.command_line();
  sweep.model = arguments.text("MODEL").empty() ? "ungm" : arguments.text("MODEL");
  sweep.platform = platform_from(arguments.text("--platform"), arguments.where());
  sweep.work = work_from(arguments);
  cast_ranks(arguments, sweep);
  const auto states = model_from(arguments, sweep.model)->states();
  sweep.work.dimensions = arguments.given("--dimensions")
                              ? static_cast<std::size_t>(arguments.integer("--dimensions", 1, 1'000'000))
                              : states.size();
  sweep.work.angles =
      static_cast<std::size_t>(std::count_if(states.begin(), states.end(), [](const Quantity& s) { return s.angle; }));
  return sweep;
}

void run_sweep(simulated::Sweep& sweep, const Arguments& arguments, const std::function<void(std::size_t)>& progress) {
  check_tools(arguments.where());
  sweep.where_from = find_times(*model_from(arguments, sweep.model), arguments, sweep.work);
  sweep.rivals = rivals_of(sweep);
  std::size_t all = sweep.work.by_stages ? sweep.proposers.size() * sweep.weighers.size() : sweep.ranks.size();
  for (const Rival& rival : sweep.rivals) all += rival.ranks.size();
  const auto ran = [&] { progress(all); };
  sweep.runs =
      sweep.work.by_stages
          ? stage_parallel_sweep(sweep.platform, sweep.work, sweep.proposers, sweep.weighers, arguments.where(), ran)
          : data_parallel_sweep(sweep.platform, sweep.work, sweep.ranks, arguments.where(), ran);
  for (Rival& rival : sweep.rivals)
    rival.runs = data_parallel_sweep(sweep.platform, rival.work, rival.ranks, arguments.where(), ran);
}

std::vector<OptionSpec> simulate_cluster_options() {
  std::vector<OptionSpec> all{{"--platform", "NAME", "modern", std::string(kPlatforms), "Cluster"}};
  for (const auto& options : {share_options(), group_options(), stage_options(), work_options()})
    all.insert(all.end(), options.begin(), options.end());
  all.insert(all.end(),
             {{"--json", "FILE", "", "platform, message model and runs as JSON [none]", "Output"},
              {"--report", "FILE", "", "report with times, speed-up and efficiency, one HTML file [none]", "Output"}});
  return all;
}

Command simulate_cluster_command() {
  return {
      "simulate-cluster",
      "Run the MPI code on simulated clusters",
      {{"MODEL", "a model of the catalogue, for its states, times and weights [ungm]", false}},
      simulate_cluster_options(),
      run_simulate_cluster,
      "Needs SimGrid (Debian: libsimgrid-dev). Exit codes: 0 done, 2 wrong use, 3 bad data, 5 SimGrid is missing or "
      "failed, 6 cannot write."};
}

}  // namespace mote

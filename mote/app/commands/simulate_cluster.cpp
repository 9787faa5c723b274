#include "mote/app/commands/simulate_cluster.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"

namespace mote {
namespace {

using namespace simulated;

constexpr long long kMostRanks = 4096;
constexpr long long kMostEach = 1'000'000'000;

/// Growing numbers separated by commas.
std::vector<std::size_t> list_from(const Arguments& arguments, const std::string& option, long long most) {
  std::vector<std::size_t> all;
  std::istringstream stream(arguments.text(option));
  for (std::string part; std::getline(stream, part, ',');) {
    const auto n = integer_in(std::string(trimmed(part)));
    if (!n || *n < 1 || *n > most)
      throw Refusal(ExitCode::kWrongUse,
                    {arguments.where(), option, fmt::format("integers from 1 to {}, separated by commas", most),
                     "\"" + arguments.text(option) + "\"", "Pass " + option + " 1,2,4."});
    all.push_back(static_cast<std::size_t>(*n));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// One of two options, the first unless told.
bool second_of(const Arguments& arguments, const std::string& first, const std::string& second) {
  if (arguments.given(first) && arguments.given(second))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), first, "it, or " + second, "both", "Pass one of them."});
  return arguments.given(second);
}

void refuse_beside(const Arguments& arguments, const std::vector<std::string>& options, const std::string& beside) {
  for (const std::string& option : options)
    if (arguments.given(option))
      throw Refusal(ExitCode::kWrongUse,
                    {arguments.where(), option, "no " + option + " beside " + beside, option, "Leave it out."});
}

void check_ranks(const std::vector<std::size_t>& ranks, const Platform& platform, const Workload& work,
                 const std::string& where) {
  const auto refuse = [&](const std::string& expected) {
    throw Refusal(ExitCode::kWrongUse,
                  {where, "--ranks", expected, std::to_string(ranks.back()), "Pass fewer --ranks."});
  };
  if (platform.hosts > 0 && ranks.back() > platform.hosts)
    refuse(fmt::format("at most {}, the hosts of {}", platform.hosts, platform.name));
  const std::size_t blocks = (work.particles + kBlock - 1) / kBlock;
  if (!work.weak && ranks.back() > blocks)
    refuse(fmt::format("at most {} for {} particles, a block of {} each", blocks, work.particles, kBlock));
}

/// What a run on one core of this machine says.
struct Measurement {
  StageTimes times{};  ///< seconds a particle; on the SIMD engine all in the first
  double ess_share = 1;
};

/// Times of stages by their shares of the processor's time, which other programs do not lengthen.
StageTimes times_of(const RunRecord& record, const Plan& plan, double seconds) {
  const double a_particle = seconds / static_cast<double>(plan.particles) / static_cast<double>(record.predicted_steps);
  if (!record.stages) return {a_particle, 0, 0};
  const auto busy = [&](std::size_t stage) {
    double sum = 0;
    if (stage < record.stages->stages.size())
      for (const StageWorker& worker : record.stages->stages[stage].workers) sum += worker.busy_seconds;
    return sum;
  };
  const double last = plan.filter == FilterKind::kSisr ? record.stages->barrier_seconds : busy(2);
  const double unit = a_particle / record.step_seconds;
  return {busy(0) * unit, busy(1) * unit, last * unit};
}

/// The quickest of some runs of the model: on the SIMD engine, or by stages.
Measurement measured(const CatalogueModel& model, const Arguments& arguments, const Workload& work) {
  constexpr Step kSteps = 5;
  constexpr int kRuns = 5;
  Plan plan;
  plan.filter = work.filter;
  plan.particles = std::min<std::size_t>(work.particles, 1'000'000);
  plan.chain.chains = work.chains;
  plan.precision = work.number_bytes == 4 ? Precision::kFloat : Precision::kDouble;
  plan.proposal = arguments.text("--proposal");
  plan.seed = work.seed;
  if (work.by_stages) plan.engine = Engine::kPipeline;
  check(plan, arguments.where());
  const Recording recording = simulated_scene(model, kSteps, work.seed).recording;
  RunRequest request;
  request.where = arguments.where();
  request.states = model.states();
  Measurement quickest;
  double least = kInfinity;
  for (int k = 0; k < kRuns; ++k) {
    const auto filter = model.filter(plan, arguments.where());
    const std::clock_t start = std::clock();
    const RunRecord record = run(*filter, plan, recording, request);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (seconds >= least) continue;
    least = seconds;
    quickest = {times_of(record, plan, seconds),
                summarise(record, nullptr).mean_ess / static_cast<double>(plan.particles)};
  }
  return quickest;
}

/// Times and weights as given, or measured.
std::string find_times(const CatalogueModel& model, const Arguments& arguments, Workload& work) {
  const auto seconds = [&](const char* option) {
    return arguments.given(option) ? arguments.number(option, 0, 1e6) : 0.0;
  };
  const bool given = arguments.given("--tp") || arguments.given("--tw") || arguments.given("--td");
  const bool weights = arguments.given("--ess") || work.by_stages;
  if (arguments.given("--ess")) work.ess_share = arguments.number("--ess", 1e-9, 1);
  if (!given || !weights) {
    const Measurement measurement = measured(model, arguments, work);
    work.times = measurement.times;
    if (!weights) work.ess_share = measurement.ess_share;
  }
  if (!given) return "measured on one core of this machine";
  work.times = {seconds("--tp"), seconds("--tw"), seconds("--td")};
  return "as given";
}

/// Which ranks a sweep has.
void cast_ranks(const Arguments& arguments, Sweep& sweep) {
  if (!sweep.work.by_stages) {
    sweep.ranks = list_from(arguments, "--ranks", kMostRanks);
    check_ranks(sweep.ranks, sweep.platform, sweep.work, arguments.where());
    return;
  }
  sweep.proposers = list_from(arguments, "--proposers", static_cast<long long>(kMostStageWorkers));
  sweep.weighers = list_from(arguments, "--weighers", static_cast<long long>(kMostStageWorkers));
  const Cast largest{sweep.proposers.back(), sweep.weighers.back(), sweep.work.chains};
  if (sweep.platform.hosts > 0 && largest.ranks() > sweep.platform.hosts)
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--proposers --weighers",
                   fmt::format("at most {} ranks, the hosts of {}", sweep.platform.hosts, sweep.platform.name),
                   fmt::format("{} with {}", largest.ranks(), sweep.work.chains > 1 ? "the chains" : "the chain"),
                   "Pass fewer."});
}

Workload work_from(const Arguments& arguments) {
  Workload work;
  const std::string& where = arguments.where();
  work.by_stages = second_of(arguments, "--data-parallel", "--stage-parallel");
  work.weak = !second_of(arguments, "--weak", "--strong");
  constexpr std::array<FilterKind, 3> kFilters{FilterKind::kSisr, FilterKind::kImh, FilterKind::kAuxiliary};
  work.filter = kFilters[arguments.choice("--filter", {"sisr", "imh", "auxiliary"})];
  if (work.by_stages) {
    refuse_beside(arguments, {"--ranks", "--weak", "--strong", "--ess"}, "--stage-parallel");
  } else {
    refuse_beside(arguments, {"--proposers", "--weighers", "--chains", "--block", "--step-bytes"}, "--data-parallel");
    if (work.filter != FilterKind::kSisr)
      throw Refusal(ExitCode::kWrongUse, {where, "--filter", "sisr, whose particles ranks can share",
                                          arguments.text("--filter"), "Pass --stage-parallel."});
  }
  work.particles = static_cast<std::size_t>(arguments.integer("--particles", work.by_stages ? 1 : 1024, kMostEach));
  work.number_bytes = arguments.choice("--precision", {"float", "double"}) == 0 ? 4 : 8;
  work.chains = static_cast<std::size_t>(arguments.integer("--chains", 1, 64));
  if (work.chains > 1 && work.filter == FilterKind::kSisr)
    throw Refusal(ExitCode::kWrongUse,
                  {where, "--chains", "--filter imh or auxiliary", "--filter sisr", "Leave it out."});
  work.block = arguments.given("--block") ? static_cast<std::size_t>(arguments.integer("--block", 1, kMostEach)) : 0;
  work.step_bytes = static_cast<std::size_t>(arguments.integer("--step-bytes", 0, kMostEach));
  work.steps = static_cast<std::size_t>(arguments.integer("--steps", 1, 100'000));
  work.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 4'294'967'295));
  return work;
}

std::unique_ptr<CatalogueModel> model_from(const Arguments& arguments, const std::string& name) {
  return find_model(name, arguments.where()).make(Settings(arguments.where(), arguments.list("--set")), {});
}

ExitCode run_simulate_cluster(const Arguments& arguments) {
  Sweep sweep = sweep_from(arguments);
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  Output* page = outputs.open(arguments.text("--report"));
  {
    Progress progress("clusters");
    run_sweep(sweep, arguments, [&](std::size_t done, std::size_t all) { progress.update(done, all); });
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

void run_sweep(simulated::Sweep& sweep, const Arguments& arguments, const SweepProgress& progress) {
  check_tools(arguments.where());
  sweep.where_from = find_times(*model_from(arguments, sweep.model), arguments, sweep.work);
  sweep.runs = sweep.work.by_stages
                   ? stage_parallel_sweep(sweep.platform, sweep.work, sweep.proposers, sweep.weighers,
                                          arguments.where(), progress)
                   : data_parallel_sweep(sweep.platform, sweep.work, sweep.ranks, arguments.where(), progress);
}

std::vector<OptionSpec> simulate_cluster_options() {
  const std::string shares = "Data-parallel: ranks share the particles";
  const std::string stages = "Stage-parallel: ranks propose, weigh, run chains";
  const std::string work = "Work";
  return {{"--platform", "NAME", "modern", std::string(kPlatforms), "Cluster"},
          {"--data-parallel", "", "", "ranks share the particles (the default)", shares},
          {"--ranks", "LIST", "1,2,4,8,16", "numbers of ranks, separated by commas", shares},
          {"--weak", "", "", "N particles on every rank (the default)", shares},
          {"--strong", "", "", "N particles on all ranks together", shares},
          {"--ess", "X", "", "effective sample size over N: how far children travel [measured]", shares},
          {"--stage-parallel", "", "", "ranks have the stages of a step", stages},
          {"--proposers", "LIST", "1", "numbers of ranks that propose, each from 1 to 64", stages},
          {"--weighers", "LIST", "1", "numbers of ranks that weigh, likewise", stages},
          {"--chains", "P", "1", "chains, a rank each", stages},
          {"--block", "B", "", "particles in a message [as mote run: 16 to 1024, by N]", stages},
          {"--step-bytes", "B", "0", "bytes that rank 0 hands to all in every step besides: a frame of video", stages},
          {"--filter", "NAME", "sisr", "sisr; stage-parallel also imh and auxiliary", work},
          {"-n,--particles", "N", "1000000", "particles", work},
          {"--tp", "S", "", "seconds that a host takes to propose a particle [measured, on one core of this machine]",
           work},
          {"--tw", "S", "", "seconds to weigh it [measured; 0 beside another of the three]", work},
          {"--td", "S", "", "seconds for the chain to decide on it, or to resample [likewise]", work},
          {"--proposal", "NAME", "prior", "proposal that is measured (see mote models NAME)", work},
          {"--precision", "TYPE", "double", "float or double", work},
          {"--dimensions", "D", "", "components of a state [the model's]", work},
          {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", work, true},
          {"--steps", "T", "10", "steps that are simulated, after a first one", work},
          {"--seed", "S", "1", "seed of recording and weights", work},
          {"--json", "FILE", "", "platform, message model and runs as JSON [none]", "Output"},
          {"--report", "FILE", "", "report with times, speed-up and efficiency, one HTML file [none]", "Output"}};
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

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/explore/filters.hpp"
#include "mote/app/explore/target.hpp"
#include "mote/app/simulated/measurement.hpp"
#include "mote/base/draws.hpp"

namespace mote::explore {
namespace {

using simulated::Workload;

/// A candidate's words begin with those of mpirun: "mpirun", "-n", R.
constexpr std::size_t kMpirun = 3;

class Cluster final : public Target {
 public:
  explicit Cluster(const Space& space)
      : space_(space), platform_(simulated::platform_from(space.platform, space.where)) {
    simulated::check_tools(space_.where);
    const auto states = space_.catalogue_model->states();
    dimensions_ = states.size();
    angles_ = static_cast<std::size_t>(
        std::count_if(states.begin(), states.end(), [](const Quantity& s) { return s.angle; }));
    std::vector<Words> all;
    for (const std::string& kind : kinds_of(space_, {"sisr", "imh", "distributed", "stages"}))
      for (const std::size_t n : particles())
        for (const std::string& text : kind == "stages" ? casts(n) : shares(kind, n)) all.push_back(words_in(text));
    const std::string needs = fmt::format("ranks that have a host each on {}, and {} particles where they share them",
                                          platform_.name, kBlock);
    candidates_ = accepted(space_, all, needs, [&](const Words& words) { plan_of(words); });
  }

  std::string name() const override { return "cluster"; }
  std::string meaning() const override {
    return fmt::format("time simulated on platform {}, a particle's measured on this machine", platform_.name);
  }
  std::vector<Figure> figures() const override { return {{"time", "s", "--deadline"}, {"ranks", "", "--max-workers"}}; }
  const std::vector<Words>& candidates() const override { return candidates_; }
  bool measures() const override { return true; }

  std::vector<double> takes(std::size_t c, Memory& memory) const override {
    const Words& words = candidates_[c];
    return memory.recall(fmt::format("{} {}", platform_.name, fmt::join(words, " ")), figures().size(), [&] {
      const Plan plan = plan_of(words);
      const Workload work = work_of(plan, memory);
      const auto quiet = [] {};
      const simulated::SweepRun run =
          work.by_stages
              ? simulated::stage_parallel_sweep(platform_, work, {std::max(plan.proposers, std::size_t{1})},
                                                {std::max(plan.weighers, std::size_t{1})}, space_.where, quiet)
                    .front()
              : simulated::data_parallel_sweep(platform_, work, {ranks_of(words)}, space_.where, quiet).front();
      return std::vector<double>{run.seconds_per_step, static_cast<double>(ranks_of(words))};
    });
  }
  RunRecord run(std::size_t c, const Recording& recording, std::uint64_t seed) const override {
    Plan plan = plan_of(candidates_[c]);
    plan.engine = Engine::kFastest;  // teams give the same numbers
    plan.proposers = plan.weighers = 0;
    return run_alone(space_, plan, recording, seed);
  }
  std::string command(std::size_t c, const std::string& data) const override {
    const Words& words = candidates_[c];
    const auto own = words.begin() + kMpirun;
    return fmt::format("{} {}", fmt::join(words.begin(), own, " "), run_command_of(space_, {own, words.end()}, data));
  }

 private:
  std::vector<std::size_t> particles() const {
    if (!space_.particles.empty()) return space_.particles;
    return {4096, 8192, 16384, 32768, 65536};
  }
  std::vector<std::size_t> ranks() const {
    std::vector<std::size_t> all = space_.workers.empty() ? std::vector<std::size_t>{1, 2, 4, 8, 16} : space_.workers;
    std::erase_if(all, [&](std::size_t r) { return platform_.hosts > 0 && r > platform_.hosts; });
    return all;
  }

  /// Ranks that share the particles, a block each at least.
  std::vector<std::string> shares(const std::string& kind, std::size_t n) const {
    std::vector<std::string> all;
    for (const std::size_t r : ranks()) {
      if (r * kBlock > n) continue;
      std::string filter = fmt::format("mpirun -n {} --engine mpi --filter {} --particles {}", r, kind, n);
      if (kind == "imh") filter += " --chains 32 --chain-start weighted";
      if (kind == "distributed") filter += fmt::format(" --groups {} --exchange append", std::max<std::size_t>(r, 2));
      all.push_back(filter);
    }
    return all;
  }
  /// Ranks that have the stages of a step before one chain.
  std::vector<std::string> casts(std::size_t n) const {
    std::vector<std::string> all;
    const std::vector<std::size_t> workers = ranks();
    for (const std::size_t rp : workers)
      for (const std::size_t rw : workers)
        if (platform_.hosts == 0 || rp + rw + 1 <= platform_.hosts)
          all.push_back(
              fmt::format("mpirun -n {} --engine mpi --filter imh --particles {} --proposers {} --weighers {}",
                          rp + rw + 1, n, rp, rw));
    return all;
  }

  static std::size_t ranks_of(const Words& words) { return std::stoul(words[kMpirun - 1]); }
  static Plan plan_of(const Words& words) {
    return plan_from(arguments_from("mote run", plan_options(), {words.begin() + kMpirun, words.end()}));
  }

  Workload work_of(const Plan& plan, Memory& memory) const {
    Workload work;
    work.filter = plan.filter;
    work.by_stages = plan.proposers > 0;
    work.weak = false;
    work.particles = plan.particles;
    work.dimensions = dimensions_;
    work.angles = angles_;
    work.chains = plan.chain.chains;
    work.weighted_start = plan.chain.start == ChainStart::kWeighted;
    work.groups = plan.groups;
    const std::vector<double> found = memory.recall(
        fmt::format("particle {} {} {}", name_of(work.filter), work.by_stages ? "stages" : "step", work.particles), 4,
        [&] {
          const auto m = simulated::measured(*space_.catalogue_model, work, plan.proposal, space_.where);
          return std::vector<double>{m.times.propose, m.times.weigh, m.times.chain, m.ess_share};
        });
    work.times = {found[0], found[1], found[2]};
    work.ess_share = found[3];
    return work;
  }

  Space space_;
  simulated::Platform platform_;
  std::size_t dimensions_ = 1, angles_ = 0;
  std::vector<Words> candidates_;
};

}  // namespace

std::unique_ptr<Target> cluster(const Space& space, const Recording& /*unread*/) {
  return std::make_unique<Cluster>(space);
}

}  // namespace mote::explore

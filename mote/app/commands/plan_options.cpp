#include "mote/app/commands/plan_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mote/filter/particles.hpp"
#include "mote/software/threads.hpp"

namespace mote {
namespace {

const std::vector<std::string> kFilters{"sisr", "imh", "auxiliary", "distributed", "sqmc", "ekf", "ukf"};
const std::vector<std::string> kEngines{"fastest", "reference", "simd", "mpi", "pipeline"};
constexpr long long kMost = static_cast<long long>(kMostParticles);

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const Scheme& scheme : schemes()) names.emplace_back(scheme.name);
  return names;
}

/// Workers of a stage; 0: not told.
std::size_t workers_from(const Arguments& arguments, const std::string& option) {
  return arguments.given(option)
             ? static_cast<std::size_t>(arguments.integer(option, 1, static_cast<long long>(kMostStageWorkers)))
             : 0;
}

ChainOptions chain_from(const Arguments& arguments, FilterKind filter) {
  ChainOptions chain;
  chain.draws = arguments.given("--draws") ? static_cast<std::size_t>(arguments.integer("--draws", 1, kMost)) : 0;
  chain.chains = static_cast<std::size_t>(arguments.integer("--chains", 1, kMost));
  chain.parents = static_cast<Parents>(arguments.choice("--parents", {"iid", "permuted", "sweep"}));
  chain.start = static_cast<ChainStart>(arguments.choice("--chain-start", {"first", "weighted"}));
  chain.parent_weights = static_cast<ParentWeights>(arguments.choice("--parent-weights", {"uniform", "lookahead"}));
  if (arguments.text("--burn-in") == "auto") {
    chain.burn_in.reset();
  } else {
    chain.burn_in = static_cast<std::size_t>(arguments.integer("--burn-in", 0, kMost, "auto, or "));
  }
  if (arguments.given("--improved")) {
    if (filter != FilterKind::kImh && filter != FilterKind::kAuxiliary)
      throw Refusal(ExitCode::kWrongUse,
                    {arguments.where(), "--improved", "--filter imh or auxiliary, whose chains it improves",
                     "--filter " + std::string(name_of(filter)), "Pass --filter imh --improved."});
    if (!arguments.given("--chains")) chain.chains = 8;
    if (!arguments.given("--parents")) chain.parents = Parents::kPermuted;
    if (!arguments.given("--chain-start")) chain.start = ChainStart::kWeighted;
  }
  if (chain.parent_weights == ParentWeights::kLookahead && filter != FilterKind::kAuxiliary)
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--parent-weights lookahead", "--filter auxiliary, which weighs by pairs",
                   "--filter " + std::string(name_of(filter)), "Pass --filter auxiliary."});
  return chain;
}

}  // namespace

std::vector<OptionSpec> plan_options() {
  const std::string filter = "Filter";
  const std::string chain = "Chains (imh, auxiliary)";
  const std::string groups = "Groups (distributed)";
  const std::string engine = "Engine";
  return {
      {"--filter", "NAME", "sisr", "sisr, imh, auxiliary, distributed, sqmc, ekf or ukf", filter},
      {"-n,--particles", "N", "1000",
       "particles, from 1 to 268435456; ekf, ukf: points that stand for their Gaussian in the outputs", filter},
      {"--seed", "S", "1", "seed, an integer of at least 0; same seed, same result", filter},
      {"--resampler", "NAME", "systematic", fmt::format("{}", fmt::join(scheme_names(), ", ")), filter},
      {"--ess-threshold", "X", "1", "resample when ESS <= X N, X from 0 to 1; 1 = every step", filter},
      {"--selection-exponent", "A", "1", "resample by weights to the power A, 0 < A <= 1; survivors keep w / a",
       filter},
      {"--proposal", "NAME", "prior", "proposal density of the model (see mote models NAME)", filter},
      {"--on-collapse", "WHAT", "stop", "when all weights are zero: stop, keep the particles, or reset to the prior",
       filter},
      {"--draws", "Q", "", "proposals that chains may keep, at least N [N]", chain},
      {"--burn-in", "NB", "0", "proposals before a chain is kept, per chain; auto = from mean and largest weight",
       chain},
      {"--chains", "P", "1", "chains, from 1 to N", chain},
      {"--parents", "HOW", "iid", "how parents are chosen: iid, permuted or sweep (biased at any N)", chain},
      {"--chain-start", "HOW", "first", "first proposal, or weighted = drawn in proportion to weight", chain},
      {"--parent-weights", "HOW", "uniform",
       "auxiliary: g(k) uniform, or lookahead = half by the likelihood of the moved parent", chain},
      {"--improved", "", "", "short for --chains 8 --parents permuted --chain-start weighted", chain},
      {"--groups", "K", "1", "groups of particles, from 1 to N", groups},
      {"--group-resampling", "WHERE", "local",
       "local = inside each group, global = over all particles, rpa = each group's number of children first, rna = "
       "local, then particles change places with the neighbours', chain = local, by a Metropolis chain",
       groups},
      {"--exchange", "HOW", "none",
       "none, append, replace or swap the heaviest particles with the neighbours, before local resampling", groups},
      {"--exchange-count", "M", "1", "particles that each group sends to each neighbour", groups},
      {"--topology", "NAME", "ring",
       "neighbours: ring (the next), bidirectional (both), torus (four), hypercube (one dimension after another)",
       groups},
      {"--exchange-every", "M", "1", "exchange at the steps that are multiples of M", groups},
      {"--exchange-when", "X", "1",
       "exchange only when the effective number of groups is at most X K, X from 0 to 1; 1 = whenever due", groups},
      {"--group-weights", "HOW", "carried",
       "carried = properly weighted; reset = every group counts alike after resampling (PPF)", groups},
      {"--engine", "NAME", "fastest",
       "simd (vectors and threads: sisr, imh, auxiliary), reference (all filters), the fastest of them that has the "
       "filter; mpi (sisr, imh, auxiliary, distributed on the processes of mpirun; with --proposers or --weighers a "
       "process for each stage's worker and each chain); or pipeline (sisr, imh, auxiliary: proposing, weighing and "
       "chains side by side)",
       engine},
      {"--threads", "K", "",
       "threads; results never depend on it; the reference engine uses one [all cores; mpi: one a process]", engine},
      {"--precision", "TYPE", "double", "float or double", engine},
      {"--proposers", "R", "",
       "pipeline: blocks of particles proposed at once, mpi: processes that propose, from 1 to 64 [1]", engine},
      {"--weighers", "R", "", "pipeline: blocks weighed at once, mpi: processes that weigh, from 1 to 64 [1]", engine},
  };
}

GroupOptions exchange_from(const Arguments& arguments) {
  GroupOptions groups;
  groups.exchange = static_cast<Exchange>(arguments.choice("--exchange", {"none", "append", "replace", "swap"}));
  groups.exchange_count = static_cast<std::size_t>(arguments.integer("--exchange-count", 1, kMost));
  groups.topology =
      static_cast<Topology>(arguments.choice("--topology", {"ring", "bidirectional", "torus", "hypercube"}));
  groups.exchange_every = static_cast<std::size_t>(arguments.integer("--exchange-every", 1, kMost));
  return groups;
}

Plan plan_from(const Arguments& arguments) {
  Plan plan;
  plan.filter = static_cast<FilterKind>(arguments.choice("--filter", kFilters));
  plan.particles = static_cast<std::size_t>(arguments.integer("--particles", 1, kMost));
  plan.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  plan.precision = static_cast<Precision>(arguments.choice("--precision", {"float", "double"}));
  plan.proposal = arguments.text("--proposal");
  plan.on_collapse = static_cast<OnCollapse>(arguments.choice("--on-collapse", {"stop", "keep", "reset"}));
  plan.selection.scheme = &schemes()[arguments.choice("--resampler", scheme_names())];
  plan.selection.ess_threshold = arguments.number("--ess-threshold", 0, 1);
  plan.selection.exponent = arguments.number("--selection-exponent", 1e-6, 1);
  plan.chain = chain_from(arguments, plan.filter);
  plan.groups = exchange_from(arguments);
  plan.groups.groups = static_cast<std::size_t>(arguments.integer("--groups", 1, kMost));
  plan.groups.resampling =
      static_cast<GroupResampling>(arguments.choice("--group-resampling", {"local", "global", "rpa", "rna", "chain"}));
  plan.groups.exchange_when = arguments.number("--exchange-when", 0, 1);
  plan.groups.carry_group_weights = arguments.choice("--group-weights", {"carried", "reset"}) == 0;
  plan.engine = static_cast<Engine>(arguments.choice("--engine", kEngines));
  plan.threads = arguments.given("--threads")  ? static_cast<std::size_t>(arguments.integer("--threads", 1, 4096))
                 : plan.engine == Engine::kMpi ? 1
                                               : cores();
  plan.proposers = workers_from(arguments, "--proposers");
  plan.weighers = workers_from(arguments, "--weighers");
  check(plan, arguments.where());
  return plan;
}

std::vector<std::string> notes_on_unread(const Arguments& arguments, const Plan& plan) {
  const bool chains = plan.filter == FilterKind::kImh || plan.filter == FilterKind::kAuxiliary;
  const bool groups = plan.filter == FilterKind::kDistributed;
  std::vector<std::string> notes;
  const auto note = [&](bool unread, const std::vector<std::string>& options, const std::string& reason) {
    for (const std::string& option : options)
      if (unread && arguments.given(option))
        notes.push_back(fmt::format("{}: note: {} is not read: {}.", arguments.where(), option, reason));
  };
  const std::string filter = fmt::format("--filter {}", name_of(plan.filter));
  note(!chains, {"--draws", "--burn-in", "--chains", "--parents", "--chain-start", "--parent-weights"},
       filter + " has no chains");
  note(chains || is_gaussian(plan.filter), {"--resampler", "--ess-threshold", "--selection-exponent"},
       filter + " does not resample");
  note(plan.filter == FilterKind::kSqmc, {"--resampler", "--ess-threshold", "--selection-exponent"},
       filter + " chooses parents by its points at every step");
  note(is_gaussian(plan.filter), {"--proposal"}, filter + " proposes nothing");
  note(is_gaussian(plan.filter), {"--seed"}, filter + " draws nothing");
  note(is_gaussian(plan.filter), {"--precision"}, filter + " computes in double");
  note(plan.chain.parent_weights == ParentWeights::kLookahead, {"--parents"},
       "--parent-weights lookahead draws them by weight");
  const std::vector<std::string> how{"--exchange-count", "--topology", "--exchange-every", "--exchange-when"};
  const auto also = [&](std::vector<std::string> options) {
    options.insert(options.end(), how.begin(), how.end());
    return options;
  };
  note(!groups, also({"--groups", "--group-resampling", "--exchange", "--group-weights"}), filter + " has no groups");
  if (!groups) return notes;
  const std::string where = "--group-resampling " + arguments.text("--group-resampling");
  const GroupResampling resampling = plan.groups.resampling;
  note(plan.groups.joint(), also({"--exchange", "--group-weights"}), where + " selects over all groups");
  note(resampling == GroupResampling::kNonProportional, {"--exchange", "--group-weights"},
       where + " exchanges and carries weights by itself");
  note(resampling == GroupResampling::kChain, {"--resampler", "--selection-exponent"}, where + " runs a chain");
  note(plan.groups.exchange == Exchange::kNone &&
           (resampling == GroupResampling::kLocal || resampling == GroupResampling::kChain),
       how, "--exchange none exchanges nothing");
  return notes;
}

}  // namespace mote

#include "mote/engine/plan.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "mote/base/refusal.hpp"
#include "mote/engine/cast.hpp"
#include "mote/engine/team.hpp"
#include "mote/filter/particles.hpp"
#include "mote/filter/topology.hpp"

namespace mote {
namespace {

void require(bool holds, const std::string& where, const std::string& what, const std::string& expected,
             const std::string& got, const std::string& next) {
  if (!holds) throw Refusal(ExitCode::kWrongUse, {where, what, expected, got, next});
}

void check_chain(const Plan& plan, const std::string& where) {
  const ChainOptions& c = plan.chain;
  const std::size_t n = plan.particles;
  require(c.draws == 0 || (c.draws >= n && c.draws <= kMostParticles), where, "--draws",
          fmt::format("an integer from the number of particles ({}) to {}", n, kMostParticles), std::to_string(c.draws),
          fmt::format("Pass --draws {}.", 2 * n));
  require(c.chains >= 1 && c.chains <= n, where, "--chains",
          fmt::format("an integer from 1 to the number of particles ({})", n), std::to_string(c.chains),
          "Pass --chains 1.");
  const std::size_t burn_in = c.burn_in.value_or(0);
  require(burn_in <= kMostParticles / c.chains, where, "--burn-in",
          fmt::format("auto, or an integer from 0 to {}", kMostParticles / c.chains), std::to_string(burn_in),
          "Pass --burn-in auto.");
}

void check_groups(const Plan& plan, const std::string& where) {
  const GroupOptions& g = plan.groups;
  require(g.groups >= 1 && g.groups <= plan.particles, where, "--groups",
          fmt::format("an integer from 1 to the number of particles ({})", plan.particles), std::to_string(g.groups),
          "Pass --groups 1.");
  const bool after = g.resampling == GroupResampling::kNonProportional;
  if (!after && !g.exchanges_before()) return;
  require(g.topology != Topology::kHypercube || std::has_single_bit(g.groups), where, "--topology hypercube",
          "a power of two for --groups", std::to_string(g.groups),
          fmt::format("Pass --groups {}, or --topology torus.", std::bit_floor(g.groups)));
  require(g.exchange_every >= 1, where, "--exchange-every", "an integer of at least 1",
          std::to_string(g.exchange_every), "Pass --exchange-every 1.");
  require(g.exchange_when >= 0 && g.exchange_when <= 1, where, "--exchange-when", "a number from 0 to 1",
          fmt::format("{}", g.exchange_when), "Pass --exchange-when 0.5.");
  const std::size_t smallest = plan.particles / g.groups;
  const std::size_t others = std::max<std::size_t>(1, degree(g.topology, g.groups));
  const std::size_t most = (g.exchange == Exchange::kReplace && !after ? smallest / 2 : smallest) / others;
  require(g.exchange_count >= 1 && g.exchange_count <= most, where, "--exchange-count",
          fmt::format("an integer from 1 to {} (groups of {} particles{})", most, smallest,
                      others == 1 ? "" : fmt::format(", {} neighbours", others)),
          std::to_string(g.exchange_count), "Pass --exchange-count 1, or fewer groups.");
}

void check_stages(const Plan& plan, const std::string& where) {
  require(plan.engine != Engine::kPipeline || pipeline_has(plan), where, "--engine pipeline",
          "--filter sisr, imh or auxiliary", fmt::format("--filter {}", name_of(plan.filter)),
          "Pass --engine reference, or leave it out.");
  for (const auto& [option, workers] : {std::pair{"--proposers", plan.proposers}, {"--weighers", plan.weighers}}) {
    require(plan.engine == Engine::kPipeline || plan.engine == Engine::kMpi || workers == 0, where, option,
            "--engine pipeline or mpi, whose stages it mans", fmt::format("--engine {}", name_of(engine_of(plan))),
            fmt::format("Pass --engine pipeline {} {}.", option, workers));
    require(workers <= kMostStageWorkers, where, option, fmt::format("an integer from 1 to {}", kMostStageWorkers),
            std::to_string(workers), fmt::format("Pass {} 1.", option));
  }
}

/// A rank has one part: there are as many as parts.
void check_cast(const Plan& plan, const std::string& where) {
  require(pipeline_has(plan), where, "--engine mpi --proposers --weighers", "--filter sisr, imh or auxiliary",
          fmt::format("--filter {}", name_of(plan.filter)), "Pass --engine reference, or leave it out.");
  if (plan.team == nullptr) return;
  const Cast cast = cast_of(plan);
  require(
      plan.team->ranks() == cast.ranks(), where, "--engine mpi --proposers --weighers",
      fmt::format("{} ranks: {} that propose, {} that weigh, {}", cast.ranks(), cast.proposers, cast.weighers,
                  plan.filter == FilterKind::kSisr ? "1 that resamples" : fmt::format("{} with a chain", cast.chains)),
      std::to_string(plan.team->ranks()), fmt::format("Start mpirun -n {}.", cast.ranks()));
}

void check_ranks(const Plan& plan, const std::string& where) {
  const auto at_most = [&](std::size_t most, const std::string& expected, const std::string& next) {
    require(plan.team->ranks() <= most, where, "--engine mpi",
            fmt::format("at most {} rank{} for {}", most, most == 1 ? "" : "s", expected),
            fmt::format("{} ranks", plan.team->ranks()), next);
  };
  if (plan.filter == FilterKind::kDistributed)
    return at_most(plan.groups.groups, fmt::format("--groups {}: a group stays on one", plan.groups.groups),
                   "Start fewer ranks, or pass more --groups.");
  const std::size_t blocks = (plan.particles + kBlock - 1) / kBlock;
  at_most(blocks, fmt::format("{} particles, a block of {} each", plan.particles, kBlock),
          "Start fewer ranks, or pass more --particles.");
  if (plan.filter != FilterKind::kSisr)
    at_most(plan.chain.chains, fmt::format("--chains {}: a chain stays on one", plan.chain.chains),
            fmt::format("Pass --chains {}, or start fewer ranks.", 16 * plan.team->ranks()));
}

}  // namespace

std::string_view name_of(FilterKind filter) {
  switch (filter) {
    case FilterKind::kSisr:
      return "sisr";
    case FilterKind::kImh:
      return "imh";
    case FilterKind::kAuxiliary:
      return "auxiliary";
    case FilterKind::kDistributed:
      return "distributed";
    case FilterKind::kSqmc:
      return "sqmc";
    case FilterKind::kEkf:
      return "ekf";
    case FilterKind::kUkf:
      return "ukf";
  }
  return "";
}

std::string_view name_of(Engine engine) {
  switch (engine) {
    case Engine::kFastest:
      return "fastest";
    case Engine::kReference:
      return "reference";
    case Engine::kSimd:
      return "simd";
    case Engine::kMpi:
      return "mpi";
    case Engine::kPipeline:
      return "pipeline";
  }
  return "";
}

double bytes_needed(const Plan& plan, std::size_t dimensions) {
  if (is_gaussian(plan.filter))
    return static_cast<double>(plan.particles + 2 * dimensions) * (static_cast<double>(dimensions) * 32 + 16);
  const double state = static_cast<double>(dimensions) * (plan.precision == Precision::kFloat ? 4 : 8);
  const auto n = static_cast<double>(plan.particles);
  if (engine_of(plan) == Engine::kMpi && plan.filter == FilterKind::kSisr && !has_cast(plan)) {
    const double number = plan.precision == Precision::kFloat ? 4 : 8;
    // those that arrive and those that leave, besides
    return n / static_cast<double>(plan.team == nullptr ? 1 : plan.team->ranks()) * (4 * state + 3 * number) + 1e6;
  }
  if (engine_of(plan) == Engine::kSimd && plan.filter == FilterKind::kSisr) {
    const double number = plan.precision == Precision::kFloat ? 4 : 8;
    // weights for any other scheme or exponent are formed in double, and ancestors listed
    const bool lists = plan.selection.scheme != &systematic_scheme() || plan.selection.exponent != 1;
    return n * (2 * state + 3 * number + (lists ? 40 : 0)) + 1e6;
  }
  if (plan.filter == FilterKind::kSisr || plan.filter == FilterKind::kDistributed) return n * (state + 48);
  if (plan.filter == FilterKind::kSqmc && engine_of(plan) == Engine::kSimd)
    return n * (2 * state + 3 * (plan.precision == Precision::kFloat ? 4 : 8) + 28) + 1e6;
  if (plan.filter == FilterKind::kSqmc) return n * (2 * state + 48);
  const auto draws = static_cast<double>(plan.chain.draws == 0 ? plan.particles : plan.chain.draws);
  // `auto` may ask for as many as Q in each chain
  const double burn_in =
      static_cast<double>(plan.chain.chains) * (plan.chain.burn_in ? static_cast<double>(*plan.chain.burn_in) : draws);
  if (engine_of(plan) == Engine::kSimd || engine_of(plan) == Engine::kMpi)
    return n * state + (draws + burn_in) * (2 * state + (plan.precision == Precision::kFloat ? 16 : 32)) + 1e6;
  return n * (state + 28) + (draws + burn_in) * (state + 28);
}

void check(const Plan& plan, const std::string& where) {
  require(plan.engine != Engine::kSimd || simd_has(plan), where, "--engine simd",
          "--filter sisr or sqmc, or imh or auxiliary with --proposal prior, without --burn-in auto and lookahead",
          fmt::format("--filter {} --proposal {}", name_of(plan.filter), plan.proposal),
          "Pass --engine reference, or leave it out.");
  require(
      plan.engine != Engine::kMpi || has_cast(plan) || team_has(plan), where, "--engine mpi",
      "--filter sisr with --resampler systematic and --selection-exponent 1, imh or auxiliary with --proposal prior, "
      "without --burn-in auto and lookahead, or distributed with groups that resample by themselves",
      fmt::format("--filter {} --resampler {} --selection-exponent {} --proposal {}", name_of(plan.filter),
                  plan.selection.scheme->name, plan.selection.exponent, plan.proposal),
      "Pass --engine fastest, or --proposers and --weighers for a rank for each stage.");
  check_stages(plan, where);
  require(plan.particles >= 1 && plan.particles <= kMostParticles, where, "--particles",
          fmt::format("an integer from 1 to {}", kMostParticles), std::to_string(plan.particles),
          "Pass --particles 1000.");
  const SelectionOptions& s = plan.selection;
  require(s.ess_threshold >= 0 && s.ess_threshold <= 1, where, "--ess-threshold", "a number from 0 to 1",
          fmt::format("{}", s.ess_threshold), "Pass --ess-threshold 1 to resample at every step.");
  require(s.exponent > 0 && s.exponent <= 1, where, "--selection-exponent", "a number above 0, at most 1",
          fmt::format("{}", s.exponent), "Pass --selection-exponent 1.");
  if (plan.filter == FilterKind::kImh || plan.filter == FilterKind::kAuxiliary) check_chain(plan, where);
  if (plan.filter == FilterKind::kDistributed) check_groups(plan, where);
  if (has_cast(plan)) check_cast(plan, where);
  if (plan.team != nullptr && !has_cast(plan)) check_ranks(plan, where);
}

}  // namespace mote

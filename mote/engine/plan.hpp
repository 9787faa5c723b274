#pragma once
/// The plan of a run: every choice that decides its numbers, as data.

#include <cstdint>
#include <string>

#include "mote/filter/options.hpp"
#include "mote/model/model.hpp"

namespace mote {

enum class FilterKind { kSisr, kImh, kAuxiliary, kDistributed, kSqmc, kEkf, kUkf };
enum class Precision { kFloat, kDouble };
enum class Engine {
  kFastest,    ///< the fastest that has the plan's filter
  kReference,  ///< slow and obvious: the referee
  kSimd,       ///< vectors of particles
  kMpi,        ///< the same on a team of processes
  kPipeline,   ///< the reference's filters, the stages of a step side by side
};

/// What a filter sums up in passing.
enum class Estimates {
  kMeans,    ///< means; the SIMD engine then gives NaN as standard deviations
  kSpreads,  ///< means and standard deviations
};

class Team;

/// Proposers, or weighers, that a plan may ask for.
inline constexpr std::size_t kMostStageWorkers = 64;

/// What to run. Defaults are the papers' filters.
struct Plan {
  FilterKind filter = FilterKind::kSisr;
  std::size_t particles = 1000;
  std::uint64_t seed = 1;
  Precision precision = Precision::kDouble;
  std::string proposal = "prior";
  SelectionOptions selection;
  ChainOptions chain;
  GroupOptions groups;
  OnCollapse on_collapse = OnCollapse::kStop;
  Estimates estimates = Estimates::kSpreads;
  Engine engine = Engine::kFastest;
  std::size_t threads = 1;  ///< results never depend on them
  std::size_t proposers =
      0;  ///< Rp, blocks that kPipeline proposes at once; 0 = not told: one. Results never depend on it
  std::size_t weighers = 0;  ///< Rw, blocks that it weighs at once; likewise
  Team* team = nullptr;      ///< whom the particles are shared with, by kMpi; results do not depend on it, either
};

/// Whether the SIMD engine has the plan's filter: SISR, SQMC, and chains whose proposal is the prior, with a fixed
/// burn-in and parents of equal weight.
inline bool simd_has(const Plan& plan) {
  if (plan.filter == FilterKind::kSisr || plan.filter == FilterKind::kSqmc) return true;
  const bool chains = plan.filter == FilterKind::kAuxiliary || plan.filter == FilterKind::kImh;
  return chains && plan.proposal == Prior::kName && plan.chain.burn_in &&
         plan.chain.parent_weights == ParentWeights::kUniform;
}

/// Whether a team can run the plan's filter: SISR whose selection needs no more than the sums of the blocks, the chains
/// that the SIMD engine has, groups that select by themselves.
inline bool team_has(const Plan& plan) {
  if (plan.filter == FilterKind::kSisr)
    return plan.selection.scheme == &systematic_scheme() && plan.selection.exponent == 1;
  if (plan.filter == FilterKind::kDistributed) return !plan.groups.joint();
  return plan.filter != FilterKind::kSqmc && simd_has(plan);
}

/// Whether the pipeline engine has the plan's filter.
inline bool pipeline_has(const Plan& plan) {
  return plan.filter == FilterKind::kSisr || plan.filter == FilterKind::kImh || plan.filter == FilterKind::kAuxiliary;
}

/// The engine that runs a plan.
inline Engine engine_of(const Plan& plan) {
  if (plan.engine != Engine::kFastest) return plan.engine;
  return simd_has(plan) ? Engine::kSimd : Engine::kReference;
}

/// Name of an engine as on the command line.
std::string_view name_of(Engine engine);

/// Name of a filter as on the command line.
std::string_view name_of(FilterKind filter);

/// Whether a filter keeps one Gaussian law instead of particles.
inline bool is_gaussian(FilterKind filter) { return filter == FilterKind::kEkf || filter == FilterKind::kUkf; }

/// Bytes that a run needs for states of `dimensions` components, an upper bound.
double bytes_needed(const Plan& plan, std::size_t dimensions);

/// Refuses a plan whose numbers do not fit together (Refusal, kWrongUse), naming the option; `where` opens the
/// sentence.
void check(const Plan& plan, const std::string& where);

}  // namespace mote

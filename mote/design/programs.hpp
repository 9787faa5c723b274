#pragma once
/// The convex programs of IMH-OPT, table I: how many proposers and weighers before a chain, how many chains.

#include <array>
#include <cstddef>
#include <optional>

#include "mote/engine/latency.hpp"

namespace mote::design {

/// What is made least; ties go to fewer blocks, then to less time.
enum class Goal { kTime, kBlocks, kEnergy };

/// One number for each kind of block: proposer, weigher, chain.
struct PerBlock {
  double propose = 0, weigh = 0, chain = 0;
};

/// A step to be designed for: Q proposals to be kept from, N_b before, on P chains each N_b + Q/P (docs/design.md).
struct Demand {
  StageTimes times{};
  std::size_t kept = 1, burn_in = 0;
  std::size_t most_chains = 1;
  PerBlock weights{1, 1, 1};  ///< what a block takes of the resource: area, a price, a processor
  PerBlock energy{};          ///< joules that a block takes for a particle
  PerBlock idle{};            ///< watts that a block takes all the time
  Goal goal = Goal::kTime;
  std::optional<double> deadline;     ///< on the time of a step
  std::optional<double> most_blocks;  ///< on P (w_p R_p + w_w R_w + w_d)
  std::optional<double> most_energy;  ///< on a step's

  /// Proposals that each of `chains` chains goes through.
  double proposals(std::size_t chains) const {
    return proposals_of_a_copy(static_cast<double>(kept), static_cast<double>(burn_in), static_cast<double>(chains));
  }
};

/// Whose laws and constraints are taken.
enum class Print {
  kCorrected,  ///< with (32), (34) and (35) put right: mote/engine/latency.hpp
  kTable,      ///< table I as printed
  kEquations,  ///< (24) to (38) as printed
};

/// Real numbers of blocks, R_p and R_w for each chain, and what they come to.
struct Plant {
  double proposers = 0, weighers = 0;
  std::size_t chains = 1;
  double time = 0, blocks = 0, energy = 0;
};

/// One of the four programs.
struct CaseAnswer {
  bool feasible = false;
  Plant plant = {};
  double kkt_residual = 0;  ///< of the goal's program, see Optimum
  /// Relative fall of the time for a relative rise of R_p, and of R_w:  -d log T / d log R.
  double proposer_elasticity = 0, weigher_elasticity = 0;
};

/// The answers by Bottleneck, and the best of them.
struct Answer {
  std::array<CaseAnswer, 4> cases;
  std::optional<Bottleneck> best;  ///< none: no case is feasible

  const CaseAnswer& operator[](Bottleneck which) const { return cases[static_cast<std::size_t>(which)]; }
};

/// P (w_p R_p + w_w R_w + w_d).
double blocks_of(const Demand& demand, double proposers, double weighers, double chains);

/// P n (e_p + e_w + e_d) + P (s_p R_p + s_w R_w + s_d) time, with n proposals a chain.
double energy_of(const Demand& demand, double proposers, double weighers, std::size_t chains, double time);

/// Solves the four programs for every number of chains up to the most, R real and 0 < R <= n. The best is the least of
/// the goal, and within 1e-7 of it the one of least blocks, then of least time.
///
///   case A   R_p/T_p <= R_w/T_w <= 1/T_d      B   R_w/T_w <= R_p/T_p, 1/T_d      C   R_p/T_p <= 1/T_d <= R_w/T_w
///   case D   1/T_d <= R_p/T_p, R_w/T_w;       times as single_chain_time()
///
/// shape   times: T_p, T_w > 0, T_d >= 0
/// cost    about a millisecond a number of chains
/// source  IMH-OPT section V-B, table I
Answer optimise(const Demand& demand, Print print = Print::kCorrected);

}  // namespace mote::design

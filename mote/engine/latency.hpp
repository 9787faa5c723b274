#pragma once
/// Latency laws: what a step takes on the architectures of the papers, from what a particle takes in each stage.
///
/// n counts the proposals of a step, Q + N_b for one chain. Times are in one unit, whichever; the laws hold for blocks
/// of particles as well, with n blocks and a block's times.

#include <cstddef>

namespace mote {

/// What a stage takes for one particle: T_p to propose, T_w to weigh, T_d for the chain to decide on it.
struct StageTimes {
  double propose, weigh, chain;
};

/// Latencies K_p and K_w of the stages before the chain, where these are pipelines themselves.
struct StageLatencies {
  double propose, weigh;
};

/// One particle after the other:  (n - 1) max(T_d, T_p, T_w) + K_p + K_w + T_d.
///
/// source  IMH-HW section 5.3
double sequential_time(double n, const StageTimes& times, const StageLatencies& latencies);

/// As many proposers and weighers as there are particles:  K_p + K_w + n T_d.
///
/// source  IMH-HW (13)
double unbounded_time(double n, const StageTimes& times, const StageLatencies& latencies);

/// R pairs of proposer and weigher before one chain, with T = max(T_p, T_w):
///
///   K_p + K_w + (n - R)/R T + R T_d   where R T_d <= T,   else   K_p + K_w + n T_d
///
/// source  IMH-HW section 5.3
double paired_time(double n, double pairs, const StageTimes& times, const StageLatencies& latencies);

/// The number of pairs beyond which the chain is the slowest:  ceil(T / T_d), 1 where T_d > T.
///
/// source  IMH-HW section 5.3
std::size_t best_pairs(const StageTimes& times);

/// Proposals of each of P parallel copies of the whole, with a chain each:  N_b + N/P.
double proposals_of_a_copy(double kept, double burn_in, double copies);

/// Which stage holds the others up.
enum class Bottleneck {
  kProposals,           ///< A: R_p/T_p <= R_w/T_w <= 1/T_d
  kWeights,             ///< B: R_w/T_w is the least
  kProposalsThenChain,  ///< C: R_p/T_p <= 1/T_d <= R_w/T_w
  kChain,               ///< D: 1/T_d is the least
};

/// The case of R_p proposers and R_w weighers before one chain; where rates are equal, the first of D, B, A, C that
/// holds: those that charge what the stages before the slowest take to fill.
Bottleneck bottleneck_of(const StageTimes& times, double proposers, double weighers);

/// The time of a step in a case, which need not hold:
///
///   A   n T_p/R_p + R_p/R_w T_w + R_w T_d
///   B   T_p max(1, R_w/R_p) + n T_w/R_w + R_w T_d
///   C   n T_p/R_p + T_w + R_p T_d
///   D   T_p + T_w + n T_d
///
/// source  IMH-OPT section V-B and table I, with (32), (34) and (35) put right: docs/pipeline.md
double single_chain_time(Bottleneck which, double n, const StageTimes& times, double proposers, double weighers);

/// The same in the case that holds.
double single_chain_time(double n, const StageTimes& times, double proposers, double weighers);

/// SISR: nothing of a step begins before the step before is resampled, and nothing is resampled before all is weighed.
///
///   n T_p/R_p + T_w max(1, R_p/R_w) + barrier   where R_p/T_p <= R_w/T_w,   else   T_p max(1, R_w/R_p) + n T_w/R_w +
///   barrier
double barrier_time(double n, const StageTimes& times, double proposers, double weighers, double barrier);

}  // namespace mote

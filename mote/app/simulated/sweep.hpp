#pragma once
/// Sweeps: the program's MPI code on simulated clusters of several sizes.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mote/app/simulated/platform.hpp"
#include "mote/engine/cast.hpp"
#include "mote/engine/latency.hpp"

namespace mote::simulated {

/// How the messages of a simulated cluster take their time, in words: SimGrid's model CM02 with nothing added.
extern const std::string kMessageModel;

/// What all settings of a sweep have in common.
struct Workload {
  FilterKind filter = FilterKind::kSisr;
  bool by_stages = false;  ///< ranks have the stages of a step, else shares of the particles
  bool weak = true;        ///< particles are for each rank, else for all; by stages always for all
  std::size_t particles = 0;
  StageTimes times{};  ///< seconds a particle
  std::size_t dimensions = 1, angles = 0;
  std::size_t number_bytes = 8;
  double ess_share = 1;  ///< ESS / N of the weights; of SISR on shares
  std::size_t chains = 1;
  bool weighted_start = false;  ///< of chains on shares
  GroupOptions groups{};        ///< of the distributed filter; 0 groups: one a rank
  std::size_t block = 0;        ///< particles in a message between stages; 0: message_block()
  std::size_t step_bytes = 0;   ///< that rank 0 hands to all in every step besides
  std::size_t steps = 10;
  std::uint64_t seed = 1;

  /// Particles of so many ranks.
  std::size_t particles_of(std::size_t ranks) const { return weak && !by_stages ? ranks * particles : particles; }
  std::size_t groups_of(std::size_t ranks) const { return groups.groups == 0 ? ranks : groups.groups; }
};

/// Seconds of a particle's whole step.
inline double seconds_per_particle(const Workload& work) {
  return work.times.propose + work.times.weigh + work.times.chain;
}

/// One setting with its result.
struct SweepRun {
  std::size_t ranks = 1;
  std::size_t particles = 0;  ///< of all ranks
  Cast cast{};                ///< by stages
  double seconds_per_step = 0;
  double messages_per_step = 0, bytes_per_step = 0;  ///< of all ranks, as CountingTeam counts
  double law_seconds = 0;  ///< by stages: what the latency laws say of the same blocks, where messages take no time
  std::optional<double> predicted_seconds = {};  ///< of a step, messages included; nothing where there is no law
  double speedup = 1, efficiency = 1;
};

/// Told after every setting.
using SweepProgress = std::function<void()>;

/// Refuses to go on without SimGrid or mote-smpi (Refusal, kOutsideTool).
void check_tools(const std::string& where);

/// Simulates steps of a data-parallel filter – SISR, IMH, its auxiliary filter or the distributed one – on each number
/// of ranks, the first of which is one: what the others are compared with.
///
///   weak     efficiency = T(1) / T(R),      speed-up = R T(1) / T(R)
///   strong   efficiency = T(1) / (R T(R)),  speed-up = T(1) / T(R)
///
/// error   Refusal (kOutsideTool) when a simulation fails
/// cost    O(R log R) messages a step, some 10 us of this machine each; R a column with chains
std::vector<SweepRun> data_parallel_sweep(const Platform& platform, const Workload& work,
                                          const std::vector<std::size_t>& ranks, const std::string& where,
                                          const SweepProgress& progress);

/// Simulates steps whose stages have ranks of their own, with each number of proposers and each of weighers.
///
///   speed-up = T(first) / T,   efficiency = N (T_p + T_w + T_d) / (R T), the share of their time that ranks work
///
/// error   as data_parallel_sweep()
std::vector<SweepRun> stage_parallel_sweep(const Platform& platform, const Workload& work,
                                           const std::vector<std::size_t>& proposers,
                                           const std::vector<std::size_t>& weighers, const std::string& where,
                                           const SweepProgress& progress);

/// What the latency laws say of a step of a cast.
double law_of(const Workload& work, const Cast& cast);

/// How much faster than with one proposer a cast can be, where no stage waits for another:
///
///   max(T_p, T) / max(T_p/R_p, T),   T = max(T_w/R_w, T_d/P)
double most_speedup(const Workload& work, const Cast& cast);

}  // namespace mote::simulated

#include "mote/engine/latency.hpp"

#include <algorithm>
#include <cmath>

namespace mote {

double sequential_time(double n, const StageTimes& times, const StageLatencies& latencies) {
  return (n - 1) * std::max({times.chain, times.propose, times.weigh}) + latencies.propose + latencies.weigh +
         times.chain;
}

double unbounded_time(double n, const StageTimes& times, const StageLatencies& latencies) {
  return latencies.propose + latencies.weigh + n * times.chain;
}

double paired_time(double n, double pairs, const StageTimes& times, const StageLatencies& latencies) {
  const double slower = std::max(times.propose, times.weigh);
  if (pairs * times.chain > slower) return unbounded_time(n, times, latencies);
  return latencies.propose + latencies.weigh + (n - pairs) / pairs * slower + pairs * times.chain;
}

std::size_t best_pairs(const StageTimes& times) {
  const double slower = std::max(times.propose, times.weigh);
  return times.chain > slower ? 1 : static_cast<std::size_t>(std::ceil(slower / times.chain));
}

double proposals_of_a_copy(double kept, double burn_in, double copies) { return burn_in + kept / copies; }

Bottleneck bottleneck_of(const StageTimes& times, double proposers, double weighers) {
  // time a particle, the inverse of a rate: a chain may take none
  const double propose = times.propose / proposers;
  const double weigh = times.weigh / weighers;
  if (times.chain >= std::max(propose, weigh)) return Bottleneck::kChain;
  if (weigh >= propose) return Bottleneck::kWeights;
  return weigh >= times.chain ? Bottleneck::kProposals : Bottleneck::kProposalsThenChain;
}

double single_chain_time(Bottleneck which, double n, const StageTimes& times, double proposers, double weighers) {
  switch (which) {
    case Bottleneck::kProposals:
      return n * times.propose / proposers + proposers / weighers * times.weigh + weighers * times.chain;
    case Bottleneck::kWeights:
      return times.propose * std::max(1.0, weighers / proposers) + n * times.weigh / weighers + weighers * times.chain;
    case Bottleneck::kProposalsThenChain:
      return n * times.propose / proposers + times.weigh + proposers * times.chain;
    case Bottleneck::kChain:
      break;
  }
  return times.propose + times.weigh + n * times.chain;
}

double single_chain_time(double n, const StageTimes& times, double proposers, double weighers) {
  return single_chain_time(bottleneck_of(times, proposers, weighers), n, times, proposers, weighers);
}

double barrier_time(double n, const StageTimes& times, double proposers, double weighers, double barrier) {
  const bool proposals = proposers * times.weigh <= weighers * times.propose;
  const double stages = proposals ? n * times.propose / proposers + times.weigh * std::max(1.0, proposers / weighers)
                                  : times.propose * std::max(1.0, weighers / proposers) + n * times.weigh / weighers;
  return stages + barrier;
}

}  // namespace mote

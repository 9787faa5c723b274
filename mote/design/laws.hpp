#pragma once
/// The latency laws beside the exact schedules of what they speak of.

#include <cstdint>
#include <string>
#include <vector>

#include "mote/design/integers.hpp"

namespace mote::design {

/// What a law says of a step, and what the schedule takes.
struct LawCheck {
  std::string law;  ///< L1 to L9, as docs/pipeline.md numbers them
  double time = 0, exact_time = 0;

  /// Relative; negative where the law charges too little.
  double error() const { return time / exact_time - 1; }
};

/// Every law that speaks of the demand on whole numbers of blocks, K_p = T_p and K_w = T_w:
///
///   L1         one block of each, one after the other; of n = N_b + Q proposals, as up to L8
///   L2         as many proposers and weighers as proposals
///   L3         R_p pairs of proposer and weigher
///   L5 to L8   one chain, R_p and R_w blocks before it: the law of the case that holds
///   L4         P copies of these, the law of N_b + Q/P proposals; their schedule has whole proposals
///   L9         SISR: Q particles, no burn-in; its barrier takes Q T_d
///
/// shape   1 <= R_p, R_w; 1 <= P
/// cost    as makespan()
std::vector<LawCheck> check_laws(const Demand& demand, std::size_t proposers, std::size_t weighers, std::size_t chains);

/// The errors of a law over many demands.
struct LawErrors {
  std::string law;
  std::size_t demands = 0;
  double median = 0, least = 0, most = 0;
  double usual = 0;  ///< that nineteen of twenty keep within, either way
};

/// Draws demands: each T over six decades, Q from 10 to 10^6, N_b 0 or up to Q / 8, R_p and R_w from 1 to the lesser of
/// 1000 and n, P of 1, 2, 4 and 8; all but P evenly in their logarithms.
///
/// cost    10 us a demand
std::vector<LawErrors> survey_laws(std::size_t demands, std::uint64_t seed);

}  // namespace mote::design

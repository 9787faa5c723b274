#pragma once
/// The answer of `mote design optimise`: the four programs, the best whole numbers, what one more block buys.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/design/request.hpp"
#include "mote/design/laws.hpp"

namespace mote {

struct DesignReport {
  DesignRequest request;
  design::Answer answer;      ///< real numbers of blocks
  design::WholeAnswer whole;  ///< whole ones
  double law_time = 0;        ///< of the whole ones, by the laws; exact_time is the schedule's
  /// Pairs of proposer and weigher before one chain: ceil(T/T_d), and the fewest that are as quick as any number.
  std::size_t pairs_by_rule = 1, fewest_pairs = 1;
  /// The whole ones with one block more of a kind: their exact time.
  double one_more_proposer = 0, one_more_weigher = 0, one_more_chain = 0;
  std::vector<design::LawCheck> laws = {};  ///< all that speak of the whole ones
};

DesignReport design_report(const DesignRequest& request);

/// cases {A, B, C, D: {feasible, time, rp, rw, chains, blocks, energy, kkt_residual, elasticity_rp, elasticity_rw}},
/// best, integer {feasible, rp, rw, chains, time, exact_time, law_error, blocks, energy, proven, schedules, breaks},
/// one_more {proposer, weigher, chain: {exact_time, saves}}, pairs {rule, fewest}, laws {L1 ..: {time, exact_time,
/// error}}; null for what there is not
nlohmann::json design_json(const DesignReport& report);

/// The same for a reader.
std::string design_text(const DesignReport& report);

}  // namespace mote

#pragma once
/// Settle: what the weights of a step say, and what follows when all are zero.

#include "mote/filter/select.hpp"
#include "mote/filter/weigh.hpp"

namespace mote {

/// What a step's weights say, and the sum of the linear ones.
struct Settled {
  StepReport report;
  double total;
};

/// The report of a step from its weights; one without an observation has evidence 1.
inline Settled settled(const Judgement& judgement, bool observed) {
  StepReport report;
  report.log_evidence = observed ? judgement.log_sum : 0;
  report.ess = judgement.ess;
  return {report, judgement.total};
}

/// Normalises the weights of an observed step. Where all are zero, it leaves equal ones on the proposed particles, or –
/// kReset – those of the observation on particles drawn anew from the prior; equal ones on these if that collapses,
/// too.
///
/// source  docs/filters.md (F27)
template <Model M, class R>
Settled settle(const M& model, Step t, Rows<R> y, Cloud<R>& cloud, const Draws& draws, OnCollapse on_collapse) {
  const Judgement judgement = normalise(cloud.log_weights, cloud.weights);
  if (!judgement.collapsed) return settled(judgement, true);
  cloud.spread();
  if (on_collapse == OnCollapse::kReset) {
    draw_prior(model, cloud.x, draws, Purpose::kReset);
    weigh<M, R>(model, t, y, cloud.x, cloud.log_weights);
    if (normalise(cloud.log_weights, cloud.weights).collapsed) cloud.spread();
  }
  Settled left = settled(normalise(cloud.log_weights, cloud.weights), false);
  left.report.log_evidence = -kInfinity;
  left.report.collapsed = true;
  return left;
}

}  // namespace mote

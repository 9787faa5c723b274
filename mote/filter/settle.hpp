#pragma once
/// Settle: what the weights of a step say, and what follows when all are zero.

#include "mote/filter/select.hpp"
#include "mote/filter/weigh.hpp"

namespace mote {

/// As judge() of its weights, for a cloud whose groups may be elsewhere: sums are formed by group.
template <class R>
Judgement judge(Cloud<R>& cloud) {
  const Membership& members = *cloud.members;
  const auto logs = [&](std::size_t first, std::size_t n) { return std::span(cloud.log_weights).subspan(first, n); };
  const auto weights = [&](std::size_t first, std::size_t n) { return std::span(cloud.weights).subspan(first, n); };
  const double largest = members.largest(members.by_group([&](std::size_t first, std::size_t n) {
    double most = -kInfinity;
    for (const double l : logs(first, n)) most = most < l ? l : most;
    return most;
  }));
  if (!std::isfinite(largest)) return {-kInfinity, 0, 0, true};
  const double total = members.sum(members.by_group(
      [&](std::size_t first, std::size_t n) { return exponentiate(logs(first, n), largest, weights(first, n)); }));
  const double squares = members.sum(members.by_group([&](std::size_t first, std::size_t n) {
    return ordered_sum(n, [&, w = weights(first, n)](std::size_t i) { return w[i] * w[i]; });
  }));
  const double ess = std::min(total * total / squares, static_cast<double>(cloud.all()));
  return {largest + std::log(total), total, ess, false};
}

/// As judge(), and normalises the log weights: those of all groups have the log-sum-exp 0.
template <class R>
Judgement normalise(Cloud<R>& cloud) {
  const Judgement judgement = judge(cloud);
  if (!judgement.collapsed)
    for (double& l : cloud.log_weights) l -= judgement.log_sum;
  return judgement;
}

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
  const Judgement judgement = normalise(cloud);
  if (!judgement.collapsed) return settled(judgement, true);
  cloud.spread();
  if (on_collapse == OnCollapse::kReset) {
    draw_prior(model, cloud.x, draws, Purpose::kReset, cloud.members->offset());
    weigh<M, R>(model, t, y, cloud.x, cloud.log_weights);
    if (normalise(cloud).collapsed) cloud.spread();
  }
  Settled left = settled(normalise(cloud), false);
  left.report.log_evidence = -kInfinity;
  left.report.collapsed = true;
  return left;
}

}  // namespace mote

#pragma once
/// The reference engine: slow, obvious, double or float – the referee of every other engine.

#include <memory>
#include <string>

#include "mote/filter/imh.hpp"
#include "mote/filter/kalman.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/filter/sqmc.hpp"
#include "mote/software/proposals.hpp"
#include "mote/software/team_membership.hpp"

namespace mote {

namespace reference {

/// Which groups of a plan are here: all, unless a team shares them.
inline std::shared_ptr<const Membership> members(const Plan& plan) {
  const Groups groups(plan.particles, plan.groups.groups);
  if (plan.team == nullptr) return std::make_shared<Membership>(groups);
  return std::make_shared<TeamMembership>(groups, *plan.team);
}

template <class R, class G, Model M>
std::unique_ptr<Filter> make(const M& model, const Plan& plan) {
  switch (plan.filter) {
    case FilterKind::kSisr:
      return make_sisr<R, G>(model, plan.particles, plan.seed, plan.selection, plan.on_collapse);
    case FilterKind::kImh:
      return make_imh<R, G>(model, plan.particles, plan.seed, plan.chain, plan.on_collapse);
    case FilterKind::kAuxiliary:
      return make_auxiliary<R, G>(model, plan.particles, plan.seed, plan.chain, plan.on_collapse);
    case FilterKind::kDistributed:
      return make_distributed<R, G>(model, plan.particles, plan.seed, plan.groups, plan.selection, plan.on_collapse,
                                    members(plan));
    case FilterKind::kSqmc:
      return make_sqmc<R, G>(model, plan.particles, plan.seed, plan.on_collapse);
    case FilterKind::kEkf:
    case FilterKind::kUkf:
      break;  // they propose nothing: gaussian() makes them
  }
  return nullptr;
}

/// A filter with one Gaussian law.
///
/// error   Refusal (kWrongUse) when the model draws other than normal numbers, or cannot draw observations
template <Model M>
std::unique_ptr<Filter> gaussian(const M& model, const Plan& plan, const std::string& where) {
  const std::string what = "--filter " + std::string(name_of(plan.filter));
  if constexpr (Observable<M>) {
    if (has_normal_noise(model))
      return plan.filter == FilterKind::kEkf ? make_ekf(model, plan.particles, plan.on_collapse)
                                             : make_ukf(model, plan.particles, plan.on_collapse);
    throw Refusal(ExitCode::kWrongUse,
                  {where, what, "a model whose noise is Gaussian",
                   "one that draws uniform numbers (bearings does with dof above 0)", "Pass --filter sisr."});
  } else {
    throw Refusal(ExitCode::kWrongUse,
                  {where, what, "a model that can draw observations", "one without observe()", "Pass --filter sisr."});
  }
}

}  // namespace reference

/// A filter of the reference engine for a model and a plan that has been checked.
///
/// error   Refusal (kWrongUse) when the model has no proposal of that name, or its weights do not exist; when it draws
///         more numbers a step than quasi-random points have coordinates; when its noise is not Gaussian and the filter
///         needs that
template <Model M>
std::unique_ptr<Filter> make_reference_filter(const M& model, const Plan& plan, const std::string& where) {
  if (is_gaussian(plan.filter)) return reference::gaussian(model, plan, where);
  return with_proposal(model, plan, where, [&]<class G>(std::type_identity<G>) {
    return plan.precision == Precision::kFloat ? reference::make<float, G>(model, plan)
                                               : reference::make<double, G>(model, plan);
  });
}

}  // namespace mote

#pragma once
/// The reference engine: slow, obvious, double or float – the referee of every other engine.

#include <memory>
#include <string>

#include "mote/base/refusal.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/imh.hpp"
#include "mote/filter/kalman.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/filter/sqmc.hpp"

namespace mote {

namespace reference {

template <class R, class G, Model M>
std::unique_ptr<Filter> with_proposal(const M& model, const Plan& plan) {
  switch (plan.filter) {
    case FilterKind::kSisr:
      return make_sisr<R, G>(model, plan.particles, plan.seed, plan.selection, plan.on_collapse);
    case FilterKind::kImh:
      return make_imh<R, G>(model, plan.particles, plan.seed, plan.chain, plan.on_collapse);
    case FilterKind::kAuxiliary:
      return make_auxiliary<R, G>(model, plan.particles, plan.seed, plan.chain, plan.on_collapse);
    case FilterKind::kDistributed:
      return make_distributed<R, G>(model, plan.particles, plan.seed, plan.groups, plan.selection, plan.on_collapse);
    case FilterKind::kSqmc:
      return make_sqmc<R, G>(model, plan.particles, plan.seed, plan.on_collapse);
    case FilterKind::kEkf:
    case FilterKind::kUkf:
      break;  // they propose nothing: gaussian() makes them
  }
  return nullptr;
}

/// In which space a model has a transition density; one that names none has none.
template <Model M>
Density density_of(const M& model) {
  if constexpr (HasTransition<M>) {
    return model.density();
  } else {
    return Density::kNone;
  }
}

/// Refuses a proposal whose weights the model cannot give.
inline void check_density(Density density, const Plan& plan, const std::string& where) {
  if (density == Density::kNone)
    throw Refusal(ExitCode::kWrongUse,
                  where + ": --proposal " + plan.proposal +
                      ": the model has no transition density with these parameters (its state noise is zero or "
                      "degenerate), so only the prior can propose. Pass --proposal prior.");
  if (density == Density::kNoise && plan.filter == FilterKind::kImh)
    throw Refusal(ExitCode::kWrongUse, where + ": --proposal " + plan.proposal +
                                           ": the model's noise has fewer dimensions than its state, so the sum over "
                                           "parents of p(x | x^i) in the IMH weight (12) does not exist. Pass --filter "
                                           "auxiliary, whose weights (23) need no sum, or --proposal prior.");
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

/// Refuses quasi-random points for a model that draws more numbers a step than they have coordinates.
template <Model M>
void check_points(const M& model, const Plan& plan, const std::string& where) {
  if (plan.filter == FilterKind::kSqmc && point_dimensions(model) > Sobol::kMostDimensions)
    throw Refusal(ExitCode::kWrongUse,
                  {where, "--filter sqmc",
                   "a model that draws at most " + std::to_string(Sobol::kMostDimensions) + " numbers a step",
                   std::to_string(point_dimensions(model)), "Pass --filter sisr."});
}

template <class R, Model M>
std::unique_ptr<Filter> in_precision(const M& model, const Plan& plan, const std::string& where) {
  std::unique_ptr<Filter> filter;
  const auto offer = [&]<class G>(const G*) {
    if (plan.proposal != G::kName || filter) return;
    if constexpr (!std::is_same_v<G, Prior>) check_density(density_of(model), plan, where);
    filter = with_proposal<R, G>(model, plan);
  };
  if constexpr (requires { typename M::Proposals; }) {
    [&]<class... G>(const std::tuple<G...>*) {
      (offer(static_cast<const G*>(nullptr)), ...);
    }(static_cast<const typename M::Proposals*>(nullptr));
  } else {
    offer(static_cast<const Prior*>(nullptr));
  }
  return filter;
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
  reference::check_points(model, plan, where);
  auto filter = plan.precision == Precision::kFloat ? reference::in_precision<float>(model, plan, where)
                                                    : reference::in_precision<double>(model, plan, where);
  if (!filter)
    throw Refusal(ExitCode::kWrongUse, {where, "--proposal", "one of the model's proposals (see mote models NAME)",
                                        plan.proposal, "Pass --proposal prior."});
  return filter;
}

}  // namespace mote

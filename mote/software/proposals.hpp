#pragma once
/// A plan's proposal, by name, as a type: what every engine starts a filter with.

#include <memory>
#include <string>
#include <type_traits>

#include "mote/base/refusal.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/filter.hpp"
#include "mote/filter/sobol.hpp"
#include "mote/filter/still.hpp"

namespace mote {

/// In which space a model has a transition density; one that names none has none.
template <Model M>
Density density_of(const M& model) {
  if constexpr (HasTransition<M>) {
    return model.density();
  } else {
    return Density::kNone;
  }
}

[[noreturn]] inline void refuse_unknown_proposal(const std::string& proposal, const std::string& where) {
  throw Refusal(ExitCode::kWrongUse, {where, "--proposal", "one of the model's proposals (see mote models NAME)",
                                      proposal, "Pass --proposal prior."});
}

[[noreturn]] inline void refuse_proposal_without_density(const std::string& proposal, const std::string& where) {
  throw Refusal(ExitCode::kWrongUse,
                where + ": --proposal " + proposal +
                    ": the model has no transition density with these parameters (its state noise is zero or "
                    "degenerate), so only the prior can propose. Pass --proposal prior.");
}

/// Refuses a proposal whose weights the model cannot give.
inline void check_density(Density density, const Plan& plan, const std::string& where) {
  if (density == Density::kNone) refuse_proposal_without_density(plan.proposal, where);
  if (density == Density::kNoise && plan.filter == FilterKind::kImh)
    throw Refusal(ExitCode::kWrongUse, where + ": --proposal " + plan.proposal +
                                           ": the model's noise has fewer dimensions than its state, so the sum over "
                                           "parents of p(x | x^i) in the IMH weight (12) does not exist. Pass --filter "
                                           "auxiliary, whose weights (23) need no sum, or --proposal prior.");
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

/// make(std::type_identity<G>) for the proposal G of the model that the plan names.
///
/// error   Refusal (kWrongUse) when the model has no proposal of that name, or its weights do not exist; when it draws
///         more numbers a step than quasi-random points have coordinates
template <Model M, class Make>
std::unique_ptr<Filter> with_proposal(const M& model, const Plan& plan, const std::string& where, const Make& make) {
  check_points(model, plan, where);
  std::unique_ptr<Filter> filter;
  const auto offer = [&]<class G>(std::type_identity<G> proposal) {
    if (plan.proposal != G::kName || filter) return;
    if constexpr (!std::is_same_v<G, Prior>) check_density(density_of(model), plan, where);
    filter = make(proposal);
  };
  if constexpr (requires { typename M::Proposals; }) {
    [&]<class... G>(const std::tuple<G...>*) {
      (offer(std::type_identity<G>()), ...);
    }(static_cast<const typename M::Proposals*>(nullptr));
  } else {
    offer(std::type_identity<Prior>());
  }
  if (!filter) refuse_unknown_proposal(plan.proposal, where);
  return filter;
}

}  // namespace mote

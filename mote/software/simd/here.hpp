#pragma once
/// The SIMD engine for the instruction set that the including file is compiled for.
///
/// Compile that file with -march=... -ffp-contract=fast -fno-math-errno -fno-trapping-math -fno-signed-zeros, and keep
/// what else it holds small: inline functions of other headers are compiled for that instruction set, too.

#include <string>

#include "mote/software/proposals.hpp"
#include "mote/software/simd/importance.hpp"
#include "mote/software/simd/isa.hpp"
#include "mote/software/simd/metropolis.hpp"
#include "mote/software/simd/quasi.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// The instruction set of this file.
inline constexpr Isa kIsaHere = HWY_TARGET <= HWY_AVX3   ? Isa::kAvx512
                                : HWY_TARGET <= HWY_AVX2 ? Isa::kAvx2
                                                         : Isa::kSse4;

template <class R, class G, Model M>
std::unique_ptr<Filter> vector_filter(const M& model, const Plan& plan) {
  if (plan.filter == FilterKind::kSqmc)
    return std::make_unique<VectorQuasiFilter<M, R, G>>(model, plan.particles, plan.seed, plan.on_collapse,
                                                        plan.threads);
  if constexpr (std::is_same_v<G, Prior>)
    if (plan.filter != FilterKind::kSisr)
      return std::make_unique<VectorMetropolisFilter<M, R>>(model, plan.particles, plan.seed, plan.chain,
                                                            plan.on_collapse, plan.threads, plan.estimates, plan.team);
  return std::make_unique<VectorImportanceFilter<M, R, G>>(model, plan.particles, plan.seed, plan.selection,
                                                           plan.on_collapse, plan.threads, plan.estimates, plan.team);
}

/// A filter of the SIMD engine for a plan that has been checked and that simd_has(), or team_has() where it has a team.
///
/// error   Refusal (kWrongUse) when the model has no proposal of that name, or its weights do not exist
template <Model M>
std::unique_ptr<Filter> make_vector_filter(const M& model, const Plan& plan, const std::string& where) {
  return with_proposal(model, plan, where, [&]<class G>(std::type_identity<G>) -> std::unique_ptr<Filter> {
    return plan.precision == Precision::kFloat ? vector_filter<float, G>(model, plan)
                                               : vector_filter<double, G>(model, plan);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace mote

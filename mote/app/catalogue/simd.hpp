#pragma once
/// The SIMD engine's filters of the catalogue's models, compiled once for every instruction set, chosen at run time.

#include <memory>
#include <string>

#include "mote/base/refusal.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/filter.hpp"
#include "mote/software/simd/isa.hpp"

namespace mote {

/// A filter in the vectors of one instruction set. Defined in files of their own, compiled for it: see
/// simd_instance.hpp.
template <Model M, Isa kIsa>
std::unique_ptr<Filter> simd_filter(const M& model, const Plan& plan, const std::string& where);

/// A filter in the widest vectors of this processor.
///
/// error   as make_vector_filter
template <Model M>
std::unique_ptr<Filter> simd_filter(const M& model, const Plan& plan, const std::string& where) {
  const auto isa = best_isa();
#ifdef MOTE_SIMD_AVX512
  if (isa >= Isa::kAvx512) return simd_filter<M, Isa::kAvx512>(model, plan, where);
#endif
#ifdef MOTE_SIMD_AVX2
  if (isa >= Isa::kAvx2) return simd_filter<M, Isa::kAvx2>(model, plan, where);
#endif
#ifdef MOTE_SIMD_SSE4
  if (isa >= Isa::kSse4) return simd_filter<M, Isa::kSse4>(model, plan, where);
#endif
  throw Refusal(ExitCode::kWrongUse,
                {where, "--engine simd", "a processor with SSE4.2, AES and PCLMUL, or what mote was built for",
                 "one without them", "Pass --engine reference."});
}

}  // namespace mote

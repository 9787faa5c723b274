#pragma once
/// Every engine's filters of the catalogue's models: declared here, compiled once, in files that models.txt names (see
/// engine_instances.hpp and simd_instances.hpp). A model that is not in models.txt has make_reference_filter(),
/// make_pipeline_filter(), make_ranked_filter() and make_vector_filter(), whose meaning and errors these share.

#include <memory>
#include <string>

#include "mote/base/refusal.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/filter.hpp"
#include "mote/software/pipeline/pipeline.hpp"
#include "mote/software/simd/isa.hpp"

namespace mote {

template <Model M>
std::unique_ptr<Filter> reference_filter(const M& model, const Plan& plan, const std::string& where);

/// A filter of the pipeline engine, of the plan's size or another.
template <Model M>
std::unique_ptr<Filter> pipeline_filter(const M& model, const Plan& plan, const std::string& where);
template <Model M>
std::unique_ptr<Filter> pipeline_filter(const M& model, const Plan& plan, const std::string& where,
                                        const PipelineSize& size);

template <Model M>
std::unique_ptr<Filter> ranked_filter(const M& model, const Plan& plan, const std::string& where);

/// A filter in the vectors of one instruction set.
template <Model M, Isa kIsa>
std::unique_ptr<Filter> simd_filter(const M& model, const Plan& plan, const std::string& where);

/// A filter in the widest vectors of this processor.
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

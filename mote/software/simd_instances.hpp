#pragma once
/// Included by the files that compile a model's filters for one instruction set each; by nobody else.

#include "mote/software/engines.hpp"
#include "mote/software/simd/here.hpp"

namespace mote {

template <Model M, Isa kIsa>
std::unique_ptr<Filter> simd_filter(const M& model, const Plan& plan, const std::string& where) {
  static_assert(kIsa == kIsaHere, "this file is compiled for another instruction set");
  return make_vector_filter(model, plan, where);
}

}  // namespace mote

/// Compiles the filters of a model (by its type's name in mote).
#define MOTE_SIMD_MODEL(...)                                                                   \
  template std::unique_ptr<mote::Filter> mote::simd_filter<mote::__VA_ARGS__, mote::kIsaHere>( \
      const mote::__VA_ARGS__&, const mote::Plan&, const std::string&);

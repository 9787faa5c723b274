#pragma once
/// Included by the files that compile the filters of a model, once for all; by nobody else.

#include "mote/software/engines.hpp"
#include "mote/software/pipeline/ranked.hpp"
#include "mote/software/reference.hpp"

namespace mote {

template <Model M>
std::unique_ptr<Filter> reference_filter(const M& model, const Plan& plan, const std::string& where) {
  return make_reference_filter(model, plan, where);
}
template <Model M>
std::unique_ptr<Filter> pipeline_filter(const M& model, const Plan& plan, const std::string& where) {
  return make_pipeline_filter(model, plan, where);
}
template <Model M>
std::unique_ptr<Filter> pipeline_filter(const M& model, const Plan& plan, const std::string& where,
                                        const PipelineSize& size) {
  return make_pipeline_filter(model, plan, where, size);
}
template <Model M>
std::unique_ptr<Filter> ranked_filter(const M& model, const Plan& plan, const std::string& where) {
  return make_ranked_filter(model, plan, where);
}

}  // namespace mote

/// Compiles the filters of a model (by its type's name in mote).
#define MOTE_ENGINES(...)                                                                                      \
  template std::unique_ptr<mote::Filter> mote::reference_filter(const mote::__VA_ARGS__&, const mote::Plan&,   \
                                                                const std::string&);                           \
  template std::unique_ptr<mote::Filter> mote::pipeline_filter(const mote::__VA_ARGS__&, const mote::Plan&,    \
                                                               const std::string&);                            \
  template std::unique_ptr<mote::Filter> mote::pipeline_filter(const mote::__VA_ARGS__&, const mote::Plan&,    \
                                                               const std::string&, const mote::PipelineSize&); \
  template std::unique_ptr<mote::Filter> mote::ranked_filter(const mote::__VA_ARGS__&, const mote::Plan&,      \
                                                             const std::string&);

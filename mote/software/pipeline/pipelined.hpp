#pragma once
/// The pipeline engine: the reference engine's own filters, their stages side by side.

#include <memory>
#include <string>

#include "mote/filter/imh.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/software/pipeline/pipeline.hpp"
#include "mote/software/proposals.hpp"

namespace mote {

/// A filter with the pipeline that runs its stages.
class PipelinedFilter final : public Filter, public Staged {
 public:
  /// make(StageRunner&) gives the filter.
  template <class Make>
  PipelinedFilter(const PipelineSize& size, const Make& make) : pipeline_(size), filter_(make(pipeline_)) {}

  StepReport predict(Step t) override {
    pipeline_.begin_step(t);
    const Pipeline::Alone rest(pipeline_);
    return filter_->predict(t);
  }
  StepReport update(Step t, Rows<double> rows) override {
    pipeline_.begin_step(t);
    const Pipeline::Alone rest(pipeline_);
    return filter_->update(t, rows);
  }
  void select(Step t, StepReport& report) override {
    const Pipeline::Alone rest(pipeline_);
    filter_->select(t, report);
  }
  WeightedSet weighted() const override { return filter_->weighted(); }
  void keep(Archive& archive) override { filter_->keep(archive); }
  Moments moments(std::size_t d, bool angle) const override { return filter_->moments(d, angle); }

  StageRecord stages() const override { return pipeline_.record(); }

 private:
  Pipeline pipeline_;
  std::unique_ptr<Filter> filter_;
};

/// The pipeline of a plan: as many lines as it has chains, 64 at most.
inline PipelineSize pipeline_size(const Plan& plan) {
  const std::size_t lines = plan.filter == FilterKind::kSisr ? 1 : std::min(plan.chain.chains, kMostStageWorkers);
  return {std::max<std::size_t>(plan.proposers, 1), std::max<std::size_t>(plan.weighers, 1), lines, plan.threads};
}

namespace pipelined {

template <class R, class G, Model M>
std::unique_ptr<Filter> make(const M& model, const Plan& plan, StageRunner& runner) {
  switch (plan.filter) {
    case FilterKind::kImh:
      return make_imh<R, G>(model, plan.particles, plan.seed, plan.chain, plan.on_collapse, runner);
    case FilterKind::kAuxiliary:
      return make_auxiliary<R, G>(model, plan.particles, plan.seed, plan.chain, plan.on_collapse, runner);
    default:
      return make_sisr<R, G>(model, plan.particles, plan.seed, plan.selection, plan.on_collapse, runner);
  }
}

}  // namespace pipelined

/// A filter of the pipeline engine for a model and a plan that has been checked. Its results are those of the reference
/// engine bit by bit: it is the same code, and all that is drawn has an address.
///
/// error   Refusal (kWrongUse) when the model has no proposal of that name, or its weights do not exist
template <Model M>
std::unique_ptr<Filter> make_pipeline_filter(const M& model, const Plan& plan, const std::string& where,
                                             const PipelineSize& size) {
  return with_proposal(model, plan, where, [&]<class G>(std::type_identity<G>) {
    return std::make_unique<PipelinedFilter>(size, [&](StageRunner& runner) {
      return plan.precision == Precision::kFloat ? pipelined::make<float, G>(model, plan, runner)
                                                 : pipelined::make<double, G>(model, plan, runner);
    });
  });
}
template <Model M>
std::unique_ptr<Filter> make_pipeline_filter(const M& model, const Plan& plan, const std::string& where) {
  return make_pipeline_filter(model, plan, where, pipeline_size(plan));
}

}  // namespace mote

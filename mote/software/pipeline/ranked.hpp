#pragma once
/// A filter whose stages are run by the ranks of a team.

#include <memory>
#include <string>

#include "mote/software/pipeline/pipelined.hpp"
#include "mote/software/pipeline/rank_stages.hpp"

namespace mote {

/// The reference engine's filter on every rank of a team, each with its part in the stages. Rank 0 has all weights: it
/// alone judges, estimates and selects, then tells the others what the next step starts from. Elsewhere moments are 0
/// and the weighted set means nothing.
///
/// cost    a step waits for rank 0 three times: for its verdict, for the set, and for the last block
class RankedFilter final : public Filter {
 public:
  /// make(StageRunner&) gives the filter.
  template <class Make>
  RankedFilter(Team& team, const Cast& cast, const Make& make)
      : team_(&team), stages_(team, cast), filter_(make(stages_)) {
    Archive counts = Archive::to([&](const void*, std::size_t count) { kept_.resize(kept_.size() + count); });
    filter_->keep(counts);
  }

  StepReport predict(Step t) override { return filter_->predict(t); }  // the same on every rank
  StepReport update(Step t, Rows<double> rows) override {
    StepReport report = filter_->update(t, rows);
    team_->share(std::as_writable_bytes(std::span(&report, 1)));
    return report;
  }
  void select(Step t, StepReport& report) override {
    if (decides()) {
      filter_->select(t, report);
      std::byte* at = kept_.data();
      Archive archive = Archive::to([&](const void* bytes, std::size_t count) {
        at = std::copy_n(static_cast<const std::byte*>(bytes), count, at);
      });
      filter_->keep(archive);
    }
    team_->share(kept_);
    if (decides()) return;
    const std::byte* at = kept_.data();
    Archive archive = Archive::from(
        [&](void* bytes, std::size_t count) {
          std::copy_n(at, count, static_cast<std::byte*>(bytes));
          at += count;
        },
        kept_.size());
    filter_->keep(archive);
  }
  WeightedSet weighted() const override { return filter_->weighted(); }
  void keep(Archive& archive) override { filter_->keep(archive); }
  Moments moments(std::size_t d, bool angle) const override {
    return decides() ? filter_->moments(d, angle) : Moments{0, 0};
  }

 private:
  bool decides() const { return team_->rank() == 0; }

  Team* team_;
  RankStages stages_;
  std::unique_ptr<Filter> filter_;
  std::vector<std::byte> kept_;  // what the next step starts from
};

/// A filter of a plan that has a cast, on a rank of the plan's team. Its results are those of the reference engine bit
/// by bit, for any cast.
///
/// error   Refusal (kWrongUse) when the model has no proposal of that name, or its weights do not exist
template <Model M>
std::unique_ptr<Filter> make_ranked_filter(const M& model, const Plan& plan, const std::string& where) {
  return with_proposal(model, plan, where, [&]<class G>(std::type_identity<G>) {
    return std::make_unique<RankedFilter>(*plan.team, cast_of(plan), [&](StageRunner& runner) {
      return plan.precision == Precision::kFloat ? pipelined::make<float, G>(model, plan, runner)
                                                 : pipelined::make<double, G>(model, plan, runner);
    });
  });
}

}  // namespace mote

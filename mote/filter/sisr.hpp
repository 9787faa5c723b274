#pragma once
/// Sequential importance sampling with resampling (SISR), and the distributed filter that differs from it in selection
/// alone.

#include <memory>
#include <optional>

#include "mote/filter/elastic.hpp"
#include "mote/filter/groups.hpp"
#include "mote/filter/settle.hpp"
#include "mote/filter/stages.hpp"

namespace mote {

/// A filter of particles with importance weights.
///
///   x^i ~ g(. | x^i_{t-1}, y);   w^i = W^i_{t-1} p(y | x^i) p(x^i | x^i_{t-1}) / g(x^i | x^i_{t-1}, y)
///   evidence = sum w^i;   estimates from (x, w) before selection
///
/// shape   N particles in groups, `members` says which of them are here; R is the number type of states and
///         likelihoods, weights are double; `runner`, who runs the stages of a step, outlives the filter. Where other
///         processes have groups, too, all of them call weighted() if one does
/// error   none; a collapsed step is reported, see OnCollapse
/// cost    O(N) a step; memory about (2 D + 3) 8 N bytes
/// source  docs/filters.md (F3) to (F6), (F27); IMH-HW (4)-(6); FPGA (5)-(7)
template <Model M, class R = double, class G = Prior>
class ImportanceFilter final : public Filter, public Elastic {
 public:
  ImportanceFilter(M model, std::shared_ptr<const Membership> members, std::uint64_t seed,
                   std::unique_ptr<Selector<R>> selector, OnCollapse on_collapse,
                   StageRunner& runner = stage_by_stage())
      : model_(std::move(model)),
        proposal_(make_proposal<G>(model_)),
        seed_(seed),
        selector_(std::move(selector)),
        on_collapse_(on_collapse),
        runner_(&runner),
        moves_(runner.proposers()),
        cloud_(model_.states().size(), std::move(members)) {
    draw_prior(model_, cloud_.x, draws(0), Purpose::kPrior, cloud_.members->offset());
  }

  StepReport predict(Step t) override {
    run(t, words_of<R>(model_, Prior{}, t, some(), {}),
        [&](DrawCursor<R>& at, Stretch stretch) { move(model_, t, cloud_.x, at, stretch.first, stretch.last); }, {});
    // carried weights stay as they are: after a w / a selection their sum is 1 only in the mean, and belongs to the
    // evidence
    return told(settled(judge(cloud_), false));
  }

  StepReport update(Step t, Rows<double> rows) override {
    const auto y = rows_as<R>(rows);
    run(
        t, words_of<R>(model_, proposal_, t, some(), Rows<R>(y)),
        [&](DrawCursor<R>& at, Stretch stretch) {
          propose<M, R>(model_, proposal_, t, y, cloud_.x, cloud_.log_weights, at, stretch.first, stretch.last);
        },
        [&](Stretch stretch) { weigh<M, R>(model_, t, y, cloud_.x, cloud_.log_weights, stretch.first, stretch.last); });
    return told(settle<M, R>(model_, t, y, cloud_, draws(t), on_collapse_));
  }

  void select(Step t, StepReport& report) override {
    const Selected done = selector_->select(cloud_, report.ess, draws(t));
    report.selected = done.any;
    report.traffic = done.traffic;
  }

  WeightedSet weighted() const override {
    if (cloud_.members->has_all()) return {&cloud_.x, cloud_.weights, total_};
    return with_others();
  }

  Moments moments(std::size_t d, bool angle) const override {
    const Membership& members = *cloud_.members;
    const std::span<const R> x = cloud_.x.component(d);
    const auto mean_of = [&](auto&& f) {
      return members.sum(members.by_group([&](std::size_t first, std::size_t n) {
        return ordered_sum(n, [&](std::size_t i) {
          const double w = cloud_.weights[first + i];
          return w > 0 ? w * f(static_cast<double>(x[first + i])) : 0.0;
        });
      })) / total_;
    };
    return moments_by(mean_of, angle);
  }

  /// For one group alone; a step that does not select keeps what it has.
  void aim(std::size_t particles) override { selector_->aim(particles); }
  std::size_t weighed() const override { return cloud_.size(); }

  void keep(Archive& archive) override {
    archive(cloud_.x);
    archive.fill(std::span(cloud_.log_weights));
  }

 private:
  Draws draws(Step t) const { return {seed_, static_cast<std::uint32_t>(t)}; }

  /// The particles of all groups.
  WeightedSet with_others() const {
    const auto place = static_cast<std::ptrdiff_t>(cloud_.members->offset());
    if (!everybody_) everybody_.emplace(cloud_.x.dimensions(), cloud_.all());
    for (std::size_t d = 0; d < cloud_.x.dimensions(); ++d) {
      const std::span<R> column = everybody_->component(d);
      std::copy_n(cloud_.x.component(d).begin(), cloud_.size(), column.begin() + place);
      cloud_.members->complete(std::as_writable_bytes(column));
    }
    all_weights_.resize(cloud_.all());
    std::copy(cloud_.weights.begin(), cloud_.weights.end(), all_weights_.begin() + place);
    cloud_.members->complete(std::as_writable_bytes(std::span(all_weights_)));
    return {&*everybody_, all_weights_, total_};
  }

  StateOf<M, R> some() const {
    auto x = blank_state<R>(model_);
    cloud_.x.read(0, x);
    return x;
  }

  /// Runs the stages over all particles, each of which takes `words` numbers to be proposed.
  template <class Propose>
  void run(Step t, std::size_t words, const Propose& propose, std::function<void(Stretch)> weigh) {
    const Stretch all{0, cloud_.size()};
    runner_->run({all,
                  {{all}},
                  [&](std::size_t proposer, std::size_t, Stretch stretch) {
                    DrawCursor<R>& at = moves_[proposer];
                    at.go(draws(t), Purpose::kMove, cloud_.members->offset() + stretch.first, words);
                    propose(at, stretch);
                  },
                  std::move(weigh),
                  {},
                  [&](Stretch stretch) {
                    Memory memory;
                    add_columns(memory, cloud_.x, stretch);
                    add_column(memory, std::span(cloud_.log_weights), stretch);
                    return memory;
                  }});
  }

  StepReport told(const Settled& step) {
    total_ = step.total;
    return step.report;
  }

  M model_;
  G proposal_;
  std::uint64_t seed_;
  std::unique_ptr<Selector<R>> selector_;
  OnCollapse on_collapse_;
  StageRunner* runner_;
  std::vector<DrawCursor<R>> moves_;  // where each proposer is in the draws
  Cloud<R> cloud_;
  double total_ = 0;
  mutable std::optional<Particles<R>> everybody_;  // of other processes, too, once asked for
  mutable std::vector<double> all_weights_;
};

/// SISR: importance filter that resamples the whole set when its effective sample size falls to the threshold.
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_sisr(M model, std::size_t particles, std::uint64_t seed,
                                  const SelectionOptions& selection = {}, OnCollapse on_collapse = OnCollapse::kStop,
                                  StageRunner& runner = stage_by_stage()) {
  return std::make_unique<ImportanceFilter<M, R, G>>(
      std::move(model), std::make_shared<Membership>(Groups(particles, 1)), seed,
      std::make_unique<WholeSelector<R>>(selection), on_collapse, runner);
}

/// The distributed filter: K groups, selection inside groups or over all; `members`, if other processes have some of
/// them.
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_distributed(M model, std::size_t particles, std::uint64_t seed, const GroupOptions& groups,
                                         const SelectionOptions& selection = {},
                                         OnCollapse on_collapse = OnCollapse::kStop,
                                         std::shared_ptr<const Membership> members = nullptr) {
  if (members == nullptr) members = std::make_shared<Membership>(Groups(particles, groups.groups));
  return std::make_unique<ImportanceFilter<M, R, G>>(std::move(model), std::move(members), seed,
                                                     make_group_selector<R>(selection, groups), on_collapse);
}

}  // namespace mote

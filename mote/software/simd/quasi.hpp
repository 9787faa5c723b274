#pragma once
/// SQMC in the SIMD engine: a step of blocks as SISR's, from parents along a curve and by points for random numbers.

#include "mote/software/simd/block_pass.hpp"
#include "mote/software/simd/curve_parents.hpp"
#include "mote/software/threads.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// SQMC on vectors: QuasiFilter's points and parents, these but for the order of particles that are next to one another
/// (see CurveParents). Weights are of type R, each block in a scale of its own.
///
/// shape   N particles; R float or double
/// error   none; a collapsed step is reported, see OnCollapse
/// cost    O(N) a step; memory (2 D + 3) sizeof(R) + 20 bytes a particle; nothing is allocated after the first steps
/// source  docs/filters.md (F36) to (F39)
template <Model M, class R, class G = Prior>
class VectorQuasiFilter final : public Filter {
 public:
  VectorQuasiFilter(M model, std::size_t particles, std::uint64_t seed, OnCollapse on_collapse, std::size_t threads)
      : seed_(seed),
        on_collapse_(on_collapse),
        states_(model.states()),
        crew_(threads),
        now_(states_.size(), particles),
        next_(states_.size(), particles),
        pass_(std::move(model), particles, now_, true),
        sobol_(pass_.draws_taken()),
        parents_(states_, particles),
        weights_(pass_.blocks() * kBlock) {
    for (std::size_t k = 0; k < crew_.shares(pass_.blocks()); ++k) desks_.emplace_back(now_.dimensions());
    move_by_points<Source::kPrior, Weights::kEqual>(0, Purpose::kPrior);
    note_centres();
  }

  StepReport predict(Step t) override {
    choose_parents(t);
    move_by_points<Source::kModel, Weights::kEqual>(t, Purpose::kMove);
    note_centres();
    StepReport report;
    report.ess = pass_.totals().ess();
    return report;
  }

  StepReport update(Step t, Rows<double> rows) override {
    choose_parents(t);
    pass_.take(rows, now_);
    move_by_points<Source::kProposal, Weights::kFresh>(t, Purpose::kMove);
    StepReport report;
    report.collapsed = pass_.totals().collapsed();
    if (report.collapsed) recover(t);
    note_centres();
    report.log_evidence =
        report.collapsed ? -kInfinity : pass_.totals().log_sum() - std::log(static_cast<double>(now_.size()));
    report.ess = pass_.totals().ess();
    return report;
  }

  void select(Step, StepReport& report) override { report.selected = true; }

  WeightedSet weighted() const override {
    shown_.resize(now_.size());
    for (std::size_t i = 0; i < shown_.size(); ++i)
      shown_[i] = static_cast<double>(weights_[i]) * pass_.totals().scale_of(pass_.sums().shift(i / kBlock));
    return {&now_, shown_, pass_.totals().weight};
  }

  void keep(Archive& archive) override {
    archive(now_, pass_);
    archive.fill(std::span(weights_));
    if (archive.reads()) pass_.add_up();
    for (Moments& centre : centres_) archive(centre.mean, centre.sd);
  }

  Moments moments(std::size_t d, bool angle) const override {
    if (angle) return pass_.circular_moments(now_, d, [&](std::size_t b) { return weights_.data() + b * kBlock; });
    return pass_.moments(d);
  }

 private:
  using Pass = BlockPass<M, R, G>;
  using Source = typename Pass::Source;
  using Weights = typename Pass::Weights;

  Draws draws(Step t) const { return {seed_, static_cast<std::uint32_t>(t)}; }

  /// Notes what places the particles along the curve in the next step.
  void note_centres() {
    centres_.resize(states_.size());
    for (std::size_t d = 0; d < states_.size(); ++d) centres_[d] = moments(d, states_[d].angle);
  }

  void choose_parents(Step t) {
    chosen_ = parents_.choose({now_, weights_.data(), pass_.sums(), pass_.totals()}, centres_,
                              draws(t).uniform(Purpose::kSelect), crew_);
  }

  template <Source kSource, Weights kWeights>
  void move_by_points(Step t, Purpose purpose) {
    if (pass_.draws_taken() > sobol_.dimensions()) sobol_ = Sobol(pass_.draws_taken());
    points_.scramble(sobol_, now_.size(), draws(t));
    pass_.draw_from(&points_);
    pass<kSource, kWeights>(t, purpose);
    pass_.draw_from(nullptr);
  }

  /// One pass over all blocks, from the chosen parents; without them from the particles' own states.
  template <Source kSource, Weights kWeights>
  void pass(Step t, Purpose purpose) {
    crew_.run(pass_.blocks(), [&](std::size_t share, std::size_t first, std::size_t last) {
      const lanes::SubnormalsAreZero fast;
      typename Pass::Desk& desk = desks_[share];
      for (std::size_t b = first; b < last; ++b) {
        pass_.template start<kSource>(desk,
                                      {seed_, static_cast<std::uint32_t>(t), purpose, static_cast<std::uint32_t>(b)});
        for (std::size_t d = 0; d < now_.dimensions(); ++d) {
          fetch(now_.component(d), b, desk.columns[d]);
          desk.to[d] = next_.component(d).data() + b * kBlock;
        }
        pass_.template block<kSource, kWeights>(desk, b, t, weights_.data() + b * kBlock, nullptr);
      }
    });
    std::swap(now_, next_);
    chosen_ = {};
    pass_.add_up();
  }

  void fetch(std::span<const R> from, std::size_t b, R* to) const {
    const std::size_t start = b * kBlock;
    if (chosen_.empty()) {
      std::copy_n(from.data() + start, pass_.size_of(b), to);
      return;
    }
    for (std::size_t i = 0; i < pass_.size_of(b); ++i) to[i] = from[chosen_[start + i]];
  }

  /// What a step without any weight left goes on with.
  void recover(Step t) {
    if (on_collapse_ == OnCollapse::kReset) pass<Source::kPrior, Weights::kFresh>(t, Purpose::kReset);
    if (pass_.totals().collapsed()) pass<Source::kStay, Weights::kEqual>(t, Purpose::kMove);
  }

  std::uint64_t seed_;
  OnCollapse on_collapse_;
  std::vector<Quantity> states_;
  Crew crew_;
  Particles<R> now_, next_;
  Pass pass_;
  Sobol sobol_;
  VectorPoints<R> points_;
  CurveParents<R> parents_;
  std::span<const Index> chosen_;
  std::vector<Moments> centres_;
  AlignedVector<R> weights_;
  std::vector<typename Pass::Desk> desks_;
  mutable std::vector<double> shown_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

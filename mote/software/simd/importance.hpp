#pragma once
/// The SISR filter of the SIMD engine: the model's own lines on vectors of particles.
///
/// A step visits every block of 1024 particles once, and what a block needs stays in the first-level cache: its parents
/// are expanded from the survivors of the step before, moved, weighed against the block's largest weight and summed.
/// Selection only notes where children begin; the next step writes them as it moves them. So a step has one barrier,
/// after which the sums of the blocks are added exactly: results do not depend on the number of threads, nor on the
/// number of ranks where a team of processes shares the blocks.

#include "mote/filter/elastic.hpp"
#include "mote/filter/select.hpp"
#include "mote/software/simd/block_pass.hpp"
#include "mote/software/simd/migration.hpp"
#include "mote/software/threads.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// SISR on vectors: step by step ImportanceFilter with a WholeSelector, within rounding and the normal table's error.
/// Weights are of type R, each block in a scale of its own.
///
/// shape   N particles; R float or double; with a team, which needs a block a rank, only systematic selection with
///         exponent 1; weighted(), which all ranks then call, brings all particles to each of them
/// error   none; a collapsed step is reported, see OnCollapse
/// cost    O(N) a step; memory (2 D + 2) sizeof(R) N bytes, a column more with an ESS threshold below 1 or a selection
///         exponent; with systematic resampling at every step nothing is allocated after the first steps
/// source  docs/filters.md (F3) to (F6), (F27)
template <Model M, class R, class G = Prior>
class VectorImportanceFilter final : public Filter, public Elastic {
 public:
  VectorImportanceFilter(M model, std::size_t particles, std::uint64_t seed, const SelectionOptions& selection,
                         OnCollapse on_collapse, std::size_t threads, Estimates estimates = Estimates::kSpreads,
                         Team* team = nullptr)
      : seed_(seed),
        team_(team),
        share_(particles, team),
        log_all_(std::log(static_cast<double>(particles))),
        children_(particles),
        selection_(selection),
        on_collapse_(on_collapse),
        carries_(selection.ess_threshold < 1 || selection.exponent != 1),
        crew_(threads),
        now_(model.states().size(), share_.count),
        next_(model.states().size(), share_.count),
        pass_(std::move(model), share_.count, now_, estimates == Estimates::kSpreads, team, particles) {
    if (team != nullptr) migration_.emplace(particles, now_.dimensions(), *team);
    weights_.resize(whole_blocks());
    next_weights_.resize(whole_blocks());
    if (carries_) log_weights_.resize(whole_blocks());
    for (std::size_t k = 0; k < crew_.shares(pass_.blocks()); ++k) desks_.emplace_back(now_.dimensions());
    if (migration_)
      for (Desk& desk : desks_) desk.spare.resize(kBlock);
    pass<Source::kPrior, Weights::kEqual>(0, Purpose::kPrior);
  }

  StepReport predict(Step t) override {
    if (level_)
      pass<Source::kModel, Weights::kEqual>(t, Purpose::kMove);
    else
      pass<Source::kModel, Weights::kKept>(t, Purpose::kMove);
    StepReport report;
    report.ess = pass_.totals().ess();
    return report;
  }

  StepReport update(Step t, Rows<double> rows) override {
    pass_.take(rows, now_);
    const double mass = level_ ? log_all_ : 0;
    if (level_)
      pass<Source::kProposal, Weights::kFresh>(t, Purpose::kMove);
    else
      pass<Source::kProposal, Weights::kCarried>(t, Purpose::kMove);
    level_ = false;
    if (pass_.totals().collapsed()) return recovered(t);
    mass_ = pass_.totals().log_sum();
    StepReport report;
    report.log_evidence = mass_ - mass;
    report.ess = pass_.totals().ess();
    return report;
  }

  void select(Step t, StepReport& report) override {
    report.selected = report.ess <= selection_.ess_threshold * static_cast<double>(share_.all);
    if (!report.selected) return;
    const Draws draws{seed_, static_cast<std::uint32_t>(t)};
    if (selection_.scheme == &systematic_scheme() && selection_.exponent == 1) {
      pass_.sums().map_children(pass_.totals(), draws.uniform(Purpose::kSelect), children_, map_);
      make_room();
      parents_ = Parents::kMapped;
      level_ = true;
    } else {
      list_parents(draws);
    }
  }

  /// Without a team.
  void aim(std::size_t particles) override { children_ = particles; }
  std::size_t weighed() const override { return now_.size(); }

  WeightedSet weighted() const override {
    shown_.resize(share_.all);
    for (std::size_t b = 0; b < pass_.blocks(); ++b) {
      const double scale = pass_.totals().scale_of(pass_.sums().shift(b));
      for (std::size_t i = b * kBlock; i < std::min((b + 1) * kBlock, now_.size()); ++i)
        shown_[share_.first + i] = static_cast<double>(weights_[i]) * scale;
    }
    return {migration_ ? &with_others() : &now_, shown_, pass_.totals().weight};
  }

  void keep(Archive& archive) override {
    archive(now_, parents_, level_, mass_, pass_, map_, ancestors_);
    archive.fill(std::span(weights_));
    archive.fill(std::span(log_weights_));
    if (parents_ == Parents::kListed) archive.fill(std::span(next_weights_));  // the children carry them
  }

  Moments moments(std::size_t d, bool angle) const override {
    if (angle) return pass_.circular_moments(now_, d, [&](std::size_t b) { return weights_.data() + b * kBlock; });
    return pass_.moments(d);
  }

 private:
  using Pass = BlockPass<M, R, G>;
  using Source = typename Pass::Source;
  using Weights = typename Pass::Weights;

  enum class Parents { kInPlace, kMapped, kListed };

  /// What one share of a step works with.
  struct Desk : Pass::Desk {
    SurvivorStream<R, Pass::kD> stream;
    Particles<R> spare;  // of a block, where a team shares the particles

    explicit Desk(std::size_t dimensions) : Pass::Desk(dimensions), stream(dimensions), spare(dimensions, 0) {}
  };

  /// The particles of all ranks; their weights, too.
  const Particles<R>& with_others() const {
    if (!everybody_) everybody_.emplace(now_.dimensions(), share_.all);
    const auto begins = begins_of_shares(share_.all, team_->ranks());
    team_->complete(std::as_writable_bytes(std::span(shown_)), begins);
    for (std::size_t d = 0; d < now_.dimensions(); ++d) {
      const std::span<R> column = everybody_->component(d);
      std::copy_n(now_.component(d).data(), share_.count, column.data() + share_.first);
      team_->complete(std::as_writable_bytes(column), begins);
    }
    return *everybody_;
  }

  std::size_t whole_blocks() const { return pass_.blocks() * kBlock; }

  /// Makes room for the children of a selection, where they are not as many as their parents.
  void make_room() {
    if (children_ != share_.all) {
      share_ = Share(children_, nullptr);
      log_all_ = std::log(static_cast<double>(children_));
      pass_.resize(share_.count);
      if (carries_) log_weights_.resize(whole_blocks());
      while (desks_.size() < crew_.shares(pass_.blocks())) desks_.emplace_back(now_.dimensions());
    }
    next_.resize(share_.count);
    next_weights_.resize(whole_blocks());
  }

  /// One pass over all blocks: states from their parents, weights, sums.
  template <Source kSource, Weights kWeights>
  void pass(Step t, Purpose purpose) {
    const bool moves_house = parents_ != Parents::kInPlace;
    Particles<R>& to = moves_house ? next_ : now_;
    AlignedVector<R>& weights = moves_house ? next_weights_ : weights_;
    if (migration_ && parents_ == Parents::kMapped)
      migration_->move(map_, now_, weights_.data(), desks_[0].stream, desks_[0].columns);
    crew_.run(pass_.blocks(), [&](std::size_t share, std::size_t first, std::size_t last) {
      const lanes::SubnormalsAreZero fast;
      Desk& desk = desks_[share];
      if (parents_ == Parents::kMapped) begin_children(desk, first * kBlock);
      for (std::size_t b = first; b < last; ++b) {
        const Address address{seed_, static_cast<std::uint32_t>(t), purpose,
                              static_cast<std::uint32_t>(share_.first_block() + b)};
        fetch_parents(desk, b, [&] { pass_.template start<kSource>(desk, address); });
        for (std::size_t d = 0; d < to.dimensions(); ++d) desk.to[d] = to.component(d).data() + b * kBlock;
        pass_.template block<kSource, kWeights>(desk, b, t, weights.data() + b * kBlock,
                                                carries_ ? log_weights_.data() + b * kBlock : nullptr, mass_);
      }
    });
    if (moves_house) {
      std::swap(now_, next_);
      std::swap(weights_, next_weights_);
    }
    parents_ = Parents::kInPlace;
    pass_.add_up();
  }

  void begin_children(Desk& desk, std::size_t first) const {
    if (migration_)
      migration_->begin(map_, now_, weights_.data(), first, desk.stream);
    else
      desk.stream.begin(map_, now_, weights_.data(), static_cast<std::uint32_t>(first));
  }

  /// Puts the states that block b starts from on the desk: the parents' copies, or its own. `meanwhile` is work that
  /// needs none of them.
  template <class Meanwhile>
  void fetch_parents(Desk& desk, std::size_t b, const Meanwhile& meanwhile) {
    const std::size_t start = b * kBlock;
    const std::size_t n = pass_.size_of(b);
    if (parents_ == Parents::kMapped && !migration_) {
      desk.stream.mark(static_cast<std::uint32_t>(start), n);
      meanwhile();
      return desk.stream.expand(n, desk.columns);
    }
    meanwhile();
    if (parents_ == Parents::kMapped) return migration_->fetch(start, n, desk.stream, desk.columns, desk.spare);
    for (std::size_t d = 0; d < now_.dimensions(); ++d) {
      const std::span<const R> from = now_.component(d);
      if (parents_ == Parents::kListed) {
        for (std::size_t i = 0; i < n; ++i) desk.columns[d][i] = from[ancestors_[start + i]];
      } else {
        std::copy_n(from.data() + start, n, desk.columns[d]);
      }
    }
  }

  /// Parents by any scheme, with the weights that children carry when the exponent is not 1.
  void list_parents(const Draws& draws) {
    weighted();
    std::vector<double> carried(children_);
    ancestors_ = draw_survivors(shown_, carried, 0, selection_, draws);
    make_room();
    parents_ = Parents::kListed;
    level_ = selection_.exponent == 1;
    if (level_) return;
    std::copy(carried.begin(), carried.end(), log_weights_.begin());
    mass_ = 0;
    // a step without observation goes on with these weights, in the house that it moves to
    const double largest = *std::max_element(carried.begin(), carried.end());
    for (std::size_t i = 0; i < carried.size(); ++i) next_weights_[i] = static_cast<R>(std::exp(carried[i] - largest));
    pass_.forget_scales();
  }

  /// What a step without any weight left leaves behind.
  StepReport recovered(Step t) {
    StepReport report;
    if (on_collapse_ == OnCollapse::kReset) pass<Source::kPrior, Weights::kFresh>(t, Purpose::kReset);
    if (pass_.totals().collapsed()) {
      pass<Source::kStay, Weights::kEqual>(t, Purpose::kMove);
      std::fill(log_weights_.begin(), log_weights_.end(), R(0));
    }
    mass_ = pass_.totals().log_sum();
    report.log_evidence = -kInfinity;
    report.ess = pass_.totals().ess();
    report.collapsed = true;
    return report;
  }

  std::uint64_t seed_;
  Team* team_;
  Share share_;
  double log_all_;        // log N, what level weights sum to
  std::size_t children_;  // that the next selection leaves
  SelectionOptions selection_;
  OnCollapse on_collapse_;
  bool carries_;  // log weights are kept from step to step
  Crew crew_;
  Particles<R> now_, next_;
  AlignedVector<R> weights_, next_weights_, log_weights_;
  Pass pass_;
  std::vector<Desk> desks_;
  Parents parents_ = Parents::kInPlace;
  ChildMap map_;
  std::optional<Migration<R, Pass::kD>> migration_;  // where a team shares the particles
  std::vector<Index> ancestors_;
  bool level_ = true;  // all particles weigh the same before the next step
  double mass_ = 0;    // log sum of the carried log weights
  mutable std::vector<double> shown_;
  mutable std::optional<Particles<R>> everybody_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

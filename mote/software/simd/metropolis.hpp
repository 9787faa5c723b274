#pragma once
/// The IMH filters of the SIMD engine: proposals in blocks of vectors, chains side by side.
///
/// A step visits every block of 1024 proposals once: their parents and what decides on them are drawn while
/// parents come from memory, then they are moved, weighed and summed. The chains then only compare.

#include <cstring>

#include "mote/base/permutation.hpp"
#include "mote/engine/plan.hpp"
#include "mote/software/simd/block_pass.hpp"
#include "mote/software/simd/chains.hpp"
#include "mote/software/threads.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// IMH on vectors: step by step MetropolisFilter with PairWeight – the auxiliary filter, and with g = p the IMH filter
/// – within rounding and the normal table's error. Log weights are of type R.
///
///   parents k uniform, proposals x ~ g(. | x^k_{t-1}, y), Q + P N_b of them
///   w = p(y | x) p(x | x^k) / g(x | x^k, y);   estimates sum w f(x) / sum w;   evidence = mean w
///
/// shape   N kept, Q >= N drawn, P chains; R float or double
/// error   none; a collapsed step is reported, see OnCollapse
/// cost    O(Q + P N_b) a step, a chain a lane: fewer chains than lanes leave lanes idle;
///         memory (2 D + 2) sizeof(R) (Q + P N_b) bytes
/// source  docs/filters.md (F11) to (F20), (F27)
template <Model M, class R, class G = Prior>
class VectorMetropolisFilter final : public Filter {
 public:
  VectorMetropolisFilter(M model, std::size_t particles, std::uint64_t seed, const ChainOptions& options,
                         OnCollapse on_collapse, std::size_t threads, Estimates estimates = Estimates::kSpreads)
      : seed_(seed),
        options_(options),
        on_collapse_(on_collapse),
        layout_{particles, options.draws == 0 ? particles : options.draws, options.chains, options.burn_in.value_or(0)},
        crew_(threads),
        set_(model.states().size(), particles),
        proposals_(model.states().size(), layout_.proposals()),
        pass_(std::move(model), particles, set_, estimates == Estimates::kSpreads) {
    const std::size_t blocks = (layout_.proposals() + kBlock - 1) / kBlock;
    log_weights_.resize(blocks * kBlock);
    log_uniforms_.resize(blocks * kBlock);
    for (std::size_t k = 0; k < crew_.shares(blocks); ++k) desks_.emplace_back(set_.dimensions());
    if (kCarried == 0) number_proposals();
    pass<Source::kPrior, Weights::kEqual>(0, Purpose::kPrior, set_);
  }

  StepReport predict(Step t) override {
    pass<Source::kModel, Weights::kEqual>(t, Purpose::kMove, set_);
    StepReport report;
    report.ess = pass_.totals().ess();
    return report;
  }

  StepReport update(Step t, Rows<double> rows) override {
    pass_.take(rows, set_);
    pass<Source::kProposal, Weights::kFresh>(t, Purpose::kMove, proposals_);
    if (pass_.totals().collapsed()) return recovered(t);
    StepReport report;
    report.log_evidence = pass_.totals().log_sum() - std::log(static_cast<double>(layout_.proposals()));
    report.ess = pass_.totals().ess();
    return report;
  }

  void select(Step t, StepReport& report) override {
    if (weighted_ == &set_) return;
    std::vector<Index> starts;
    if (options_.start == ChainStart::kWeighted && !report.collapsed) starts = weighted_starts(t);
    const ChainReport chain = run_chains(starts);
    report.acceptance =
        chain.offered == 0 ? kNaN : static_cast<double>(chain.accepted) / static_cast<double>(chain.offered);
    report.burn_in = layout_.burn_in;
    report.selected = true;
  }

  WeightedSet weighted() const override {
    shown_.resize(weighted_->size());
    for (std::size_t b = 0; b < pass_.blocks(); ++b) {
      const double scale = pass_.totals().scale_of(pass_.sums().shift(b));
      const R* const weights = weights_of(b);
      for (std::size_t i = 0; i < pass_.size_of(b); ++i)
        shown_[b * kBlock + i] = static_cast<double>(weights[i]) * scale;
    }
    return {weighted_, shown_, pass_.totals().weight};
  }

  void keep(Archive& archive) override { archive(set_); }

  Moments moments(std::size_t d, bool angle) const override {
    if (angle) return pass_.circular_moments(*weighted_, d, [&](std::size_t b) { return weights_of(b); });
    return pass_.moments(d);
  }

 private:
  using Pass = BlockPass<M, R, G>;
  using V = typename Pass::V;
  using Source = typename Pass::Source;
  using Weights = typename Pass::Weights;

  /// Components that chains carry along; states of more, or of how many only the run knows, are gathered afterwards.
  static constexpr std::size_t kCarried = Pass::kD <= 4 ? Pass::kD : 0;
  using Chains = ChainGroup<R, std::max<std::size_t>(kCarried, 1)>;
  using Number = std::conditional_t<std::is_same_v<R, float>, std::uint32_t, std::uint64_t>;

  /// What one share of a step works with.
  struct Desk : Pass::Desk {
    AlignedVector<R> scratch;      // weights of the block at hand, and what keeps them apart
    AlignedVector<Index> parents;  // of its proposals, with room for a vector more
    ChainReport chains;

    explicit Desk(std::size_t dimensions)
        : Pass::Desk(dimensions), scratch(kBlock + kApart), parents(kBlock + lanes::kWidth<R>) {}
  };

  /// Half a page: a store one page and a line behind a load that comes next would seem to be what it waits for.
  static constexpr std::size_t kApart = 2048 / sizeof(R);

  Address address(Step t, Purpose purpose, std::size_t b) const {
    return {seed_, static_cast<std::uint32_t>(t), purpose, static_cast<std::uint32_t>(b)};
  }

  /// One pass over all blocks of `to`: parents, states, weights, sums.
  template <Source kSource, Weights kWeights>
  void pass(Step t, Purpose purpose, Particles<R>& to) {
    pass_.resize(to.size());
    crew_.run(pass_.blocks(), [&](std::size_t share, std::size_t first, std::size_t last) {
      const lanes::SubnormalsAreZero fast;
      Desk& desk = desks_[share];
      for (std::size_t b = first; b < last; ++b) {
        for (std::size_t d = 0; d < to.dimensions(); ++d) desk.to[d] = to.component(d).data() + b * kBlock;
        if constexpr (kSource == Source::kProposal)
          fetch_parents(desk, t, b);
        else if constexpr (kSource != Source::kPrior)
          for (std::size_t d = 0; d < to.dimensions(); ++d) std::copy_n(desk.to[d], pass_.size_of(b), desk.columns[d]);
        R* const logs = log_weights_.data() + b * kBlock;
        if constexpr (kWeights == Weights::kEqual) std::fill_n(logs, pass_.size_of(b), R(0));
        pass_.template block<kSource, kWeights>(desk, b, address(t, purpose, b), desk.scratch.data() + kApart, logs);
      }
    });
    weighted_ = &to;
    pass_.add_up();
  }

  /// Puts the parents of the proposals of block b on the desk, and draws what the chains decide on these by.
  void fetch_parents(Desk& desk, Step t, std::size_t b) {
    const Deal deal{address(t, Purpose::kParent, b), address(t, Purpose::kAccept, b), pass_.size_of(b),
                    static_cast<Index>(layout_.kept)};
    if (options_.parents == mote::Parents::kIid)
      return deal_out<true>(deal, set_, desk, log_uniforms_.data() + b * kBlock);
    const Permutation permutation(layout_.kept, seed_ ^ mixed(static_cast<std::uint64_t>(t)));
    Index member = static_cast<Index>(b * kBlock % layout_.kept);
    for (std::size_t i = 0; i < deal.count; ++i) {
      desk.parents[i] = options_.parents == mote::Parents::kSweep ? member : static_cast<Index>(permutation(member));
      member = member + 1 == deal.members ? 0 : member + 1;
    }
    deal_out<false>(deal, set_, desk, log_uniforms_.data() + b * kBlock);
  }

  struct Deal {
    Address parents, uniforms;
    std::size_t count;
    Index members;
  };
  /// Draws and loads in one loop: while memory answers, the generators work.
  template <bool kDraws>
  [[gnu::flatten, gnu::noinline]] static void deal_out(const Deal& deal, const Particles<R>& set, Desk& desk,
                                                       R* log_uniforms) {
    constexpr std::size_t kWidth = lanes::kWidth<R>;
    const std::size_t count = deal.count;
    const Index members = deal.members;
    lanes::VectorDraw<R> parent(deal.parents);
    lanes::VectorDraw<R> accept(deal.uniforms);
    Index* const parents = desk.parents.data();
    const auto to = desk.columns;
    auto from = column_pointers<const R, Pass::kD>(set.dimensions());
    for (std::size_t d = 0; d < set.dimensions(); ++d) from[d] = set.component(d).data();
    if constexpr (kDraws) parent.index(members, parents);
    for (std::size_t j = 0; j < count; j += kWidth) {
      if constexpr (kDraws) parent.index(members, parents + j + kWidth);
      lanes::log_uniform(accept.uniform()).store(log_uniforms + j);
      // places behind the last proposal hold members, too: of a draw, or of a block before
      lanes::unrolled<kWidth>([&](std::size_t i) {
        const Index at = parents[j + i];
        // memcpy: moved as a whole number, which takes a port that the generators leave free
        for (std::size_t d = 0; d < to.size(); ++d) std::memcpy(to[d] + j + i, from[d] + at, sizeof(R));
      });
    }
  }

  /// Runs the chains over the proposals; the set is what they keep.
  ChainReport run_chains(std::span<const Index> starts) {
    const std::size_t groups = Chains::groups(layout_);
    const std::size_t blocks = pass_.blocks();
    const auto [from, to] = carried_columns();
    for (Desk& desk : desks_) desk.chains = {};
    // shared out by the blocks' number, which says how much work there is
    crew_.run(blocks, [&](std::size_t share, std::size_t first, std::size_t last) {
      const lanes::SubnormalsAreZero fast;
      for (std::size_t g = groups * first / blocks; g < groups * last / blocks; ++g) {
        const ChainReport group = Chains(layout_, g, log_weights_.data(), log_uniforms_.data(), from, starts).run(to);
        desks_[share].chains.offered += group.offered;
        desks_[share].chains.accepted += group.accepted;
      }
    });
    if constexpr (kCarried == 0) gather();
    ChainReport all;
    for (const Desk& desk : desks_) {
      all.offered += desk.chains.offered;
      all.accepted += desk.chains.accepted;
    }
    return all;
  }

  auto carried_columns() {
    std::pair<std::array<const R*, Chains::kColumnCount>, std::array<R*, Chains::kColumnCount>> all;
    if constexpr (kCarried == 0) {
      all.first[0] = numbers_.data();
      all.second[0] = picks_.data();
    } else {
      for (std::size_t d = 0; d < kCarried; ++d) {
        all.first[d] = proposals_.component(d).data();
        all.second[d] = set_.component(d).data();
      }
    }
    return all;
  }

  /// Numbers of proposals as chains carry them: the bits of an index in an R.
  void number_proposals() {
    picks_.resize(layout_.kept);
    numbers_.resize(layout_.proposals());
    for (std::size_t j = 0; j < numbers_.size(); ++j) numbers_[j] = std::bit_cast<R>(static_cast<Number>(j));
  }
  void gather() {
    crew_.run((layout_.kept + kBlock - 1) / kBlock, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t d = 0; d < set_.dimensions(); ++d)
        for (std::size_t j = first * kBlock; j < std::min(last * kBlock, layout_.kept); ++j)
          set_.component(d)[j] = proposals_.component(d)[std::bit_cast<Number>(picks_[j])];
    });
  }

  /// As MetropolisFilter draws them: systematic by the weights of all proposals, dealt to the chains from a random one
  /// on.
  std::vector<Index> weighted_starts(Step t) const {
    const Draws draws{seed_, static_cast<std::uint32_t>(t)};
    weighted();
    std::vector<Index> starts(layout_.chains);
    systematic(shown_, draws, starts);
    auto block = draws.block(Purpose::kStart);
    const std::size_t shift = block.particle(0).index(starts.size());
    std::rotate(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(shift), starts.end());
    return starts;
  }

  /// The weights of block b, in its scale.
  const R* weights_of(std::size_t b) const {
    shown_block_.resize(kBlock);
    pass_.weigh_again(b, log_weights_.data() + b * kBlock, shown_block_.data());
    return shown_block_.data();
  }

  /// What a step without any weight left leaves behind.
  StepReport recovered(Step t) {
    if (on_collapse_ == OnCollapse::kReset) pass<Source::kPrior, Weights::kFresh>(t, Purpose::kReset, proposals_);
    if (pass_.totals().collapsed()) pass<Source::kStay, Weights::kEqual>(t, Purpose::kMove, proposals_);
    StepReport report;
    report.log_evidence = -kInfinity;
    report.ess = pass_.totals().ess();
    report.collapsed = true;
    return report;
  }

  std::uint64_t seed_;
  ChainOptions options_;
  OnCollapse on_collapse_;
  ChainLayout layout_;
  Crew crew_;
  Particles<R> set_, proposals_;                 // the unweighted set S_{t-1}; the proposals of this step
  AlignedVector<R> log_weights_, log_uniforms_;  // of the proposals; the latter decide on them
  AlignedVector<R> numbers_, picks_;             // where chains do not carry the states
  Pass pass_;
  std::vector<Desk> desks_;
  const Particles<R>* weighted_ = &set_;
  mutable std::vector<double> shown_;
  mutable AlignedVector<R> shown_block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

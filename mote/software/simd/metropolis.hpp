#pragma once
/// The IMH filters of the SIMD engine: proposals in blocks of vectors, chains side by side.
///
/// A step visits every block of 1024 proposals once: their parents and what decides on them are drawn while
/// parents come from memory, then they are moved, weighed and summed. The chains then only compare.
///
/// Where a team shares the chains, a rank makes the proposals that its chains visit, and what all chains keep is told
/// to all: any of it may be the parent of any proposal. A block of proposals that chains of two ranks visit is made by
/// both, so that results do not depend on the number of ranks.

#include <cstring>
#include <numeric>

#include "mote/base/permutation.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/elastic.hpp"
#include "mote/software/share.hpp"
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
/// shape   N kept, Q >= N drawn, P chains; R float or double; with a team, which needs a chain and a block of N a rank,
///         all ranks call weighted() if one does
/// error   none; a collapsed step is reported, see OnCollapse
/// cost    O(Q + P N_b) a step, a chain a lane: fewer chains than lanes leave lanes idle;
///         memory (2 D + 2) sizeof(R) (Q + P N_b) bytes
/// source  docs/filters.md (F11) to (F20), (F27)
template <Model M, class R, class G = Prior>
class VectorMetropolisFilter final : public Filter, public Elastic {
 public:
  VectorMetropolisFilter(M model, std::size_t particles, std::uint64_t seed, const ChainOptions& options,
                         OnCollapse on_collapse, std::size_t threads, Estimates estimates = Estimates::kSpreads,
                         Team* team = nullptr)
      : seed_(seed),
        team_(team),
        options_(options),
        on_collapse_(on_collapse),
        layout_{particles, options.draws == 0 ? particles : options.draws, options.chains, options.burn_in.value_or(0)},
        share_(layout_, team),
        aimed_(particles),
        blocks_of_set_(shared_set()),
        blocks_of_proposals_(shared_proposals()),
        crew_(threads),
        set_(model.states().size(), particles),
        proposals_(model.states().size(), layout_.proposals()),
        pass_(std::move(model), particles, set_, estimates == Estimates::kSpreads, team, particles) {
    make_room();
    pass<Source::kPrior, Weights::kEqual>(0, Purpose::kPrior, set_);
  }

  StepReport predict(Step t) override {
    complete_what_was_read();
    pass<Source::kModel, Weights::kEqual>(t, Purpose::kMove, set_);
    StepReport report;
    report.ess = pass_.totals().ess();
    return report;
  }

  StepReport update(Step t, Rows<double> rows) override {
    complete_what_was_read();
    if (aimed_ != layout_.kept) follow_aim();
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
    if (set_.size() != layout_.kept) {
      set_.resize(layout_.kept);
      blocks_of_set_ = shared_set();
    }
    std::vector<Index> starts;
    if (options_.start == ChainStart::kWeighted && !report.collapsed) starts = weighted_starts(t);
    const ChainReport chain = run_chains(starts);
    if (team_ != nullptr) complete(set_, share_.begins(layout_.kept));
    const double offered = over_all(chain.offered);
    report.acceptance = offered == 0 ? kNaN : over_all(chain.accepted) / offered;
    report.burn_in = layout_.burn_in;
    report.selected = true;
  }

  WeightedSet weighted() const override {
    weigh_all();
    if (team_ != nullptr && weighted_ == &proposals_)
      for (std::size_t d = 0; d < proposals_.dimensions(); ++d) complete_proposals(proposals_.component(d));
    return {weighted_, shown_, pass_.totals().weight};
  }

  /// Without a team; chains then keep all that they draw.
  void aim(std::size_t particles) override { aimed_ = particles; }
  std::size_t weighed() const override { return weighted_->size(); }

  /// A team's lowest rank keeps the set for all.
  void keep(Archive& archive) override {
    if (share_.rank == 0) archive(set_);
    if (archive.reads()) complete_ = share_.ranks == 1;
  }

  Moments moments(std::size_t d, bool angle) const override {
    if (angle) return pass_.circular_moments(*weighted_, d, [&](std::size_t b) { return weights_of(b); });
    return pass_.moments(d);
  }

 private:
  using Pass = BlockPass<M, R, G>;
  using V = typename Pass::V;
  using Source = typename Pass::Source;
  using Weights = typename Pass::Weights;

  BlockShare shared_set() const {
    return {blocks_of(layout_.kept), share_.rank, [&](std::size_t r) {
              const Share share(layout_.kept, share_.ranks, r);
              return std::array{Stretch{share.first, share.end()}};
            }};
  }
  BlockShare shared_proposals() const {
    return {blocks_of(layout_.proposals()), share_.rank, [&](std::size_t r) { return share_.visited(r); }};
  }
  /// Makes room for the proposals of the layout.
  void make_room() {
    log_weights_.resize(blocks_of(layout_.proposals()) * kBlock);
    log_uniforms_.resize(log_weights_.size());
    const std::size_t most = std::max(blocks_of_set_.made.size(), blocks_of_proposals_.made.size());
    while (desks_.size() < crew_.shares(most)) desks_.emplace_back(set_.dimensions());
  }
  /// The next proposals are as many as was aimed at; their parents are the set as it is.
  void follow_aim() {
    layout_.kept = layout_.draws = aimed_;
    share_ = ChainShare(layout_, team_);
    blocks_of_proposals_ = shared_proposals();
    proposals_.resize(layout_.proposals());
    make_room();
  }

  /// The weights of all particles, whoever made them.
  void weigh_all() const {
    if (team_ != nullptr) {
      if (weighted_ == &set_)
        team_->complete(std::as_writable_bytes(std::span(log_weights_).first(layout_.kept)),
                        begins_of_shares(layout_.kept, share_.ranks));
      else
        complete_proposals(log_weights_);
      pass_.complete_scales();
    }
    shown_.resize(weighted_->size());
    for (std::size_t b = 0; b < pass_.blocks(); ++b) {
      const double scale = pass_.totals().scale_of(pass_.sums().shift(b));
      const R* const weights = weights_of(b);
      for (std::size_t i = 0; i < pass_.size_of(b); ++i)
        shown_[b * kBlock + i] = static_cast<double>(weights[i]) * scale;
    }
  }
  /// Every rank has what its own chains visit of a column of proposals, and gets the others'.
  void complete_proposals(std::span<R> column) const {
    const auto part = [&](std::size_t first, std::size_t n) {
      team_->complete(std::as_writable_bytes(column.subspan(first, n)), share_.begins(n));
    };
    part(0, layout_.draws);
    part(layout_.draws, layout_.chains * layout_.burn_in);
  }

  using Chains = ChainGroup<R>;
  using Number = std::conditional_t<std::is_same_v<R, float>, std::uint32_t, std::uint64_t>;

  /// What one share of a step works with.
  struct Desk : Pass::Desk {
    AlignedVector<R> scratch;      // weights of the block at hand, and what keeps them apart
    AlignedVector<Index> parents;  // of its proposals, with room for a vector more
    AlignedVector<R> held;         // states of the chains at hand
    ChainReport chains;

    explicit Desk(std::size_t dimensions)
        : Pass::Desk(dimensions),
          scratch(kBlock + kApart),
          parents(kBlock + lanes::kWidth<R>),
          held(dimensions * Chains::kLanes) {}
  };

  /// Half a page: a store one page and a line behind a load that comes next would seem to be what it waits for.
  static constexpr std::size_t kApart = 2048 / sizeof(R);

  Address address(Step t, Purpose purpose, std::size_t b) const {
    return {seed_, static_cast<std::uint32_t>(t), purpose, static_cast<std::uint32_t>(b)};
  }

  /// Every rank has its part of each component, and gets the others'.
  void complete(Particles<R>& x, std::span<const std::size_t> begins) const {
    for (std::size_t d = 0; d < x.dimensions(); ++d) team_->complete(std::as_writable_bytes(x.component(d)), begins);
  }
  void complete_what_was_read() {
    if (complete_) return;
    for (std::size_t d = 0; d < set_.dimensions(); ++d) team_->share(std::as_writable_bytes(set_.component(d)));
    complete_ = true;
  }
  /// The sum of a count over the ranks.
  double over_all(std::size_t count) const {
    if (team_ == nullptr) return static_cast<double>(count);
    const auto counts = team_->gather(static_cast<std::uint32_t>(count));
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  }

  /// One pass over the blocks of `to` that are made here: parents, states, weights, sums.
  template <Source kSource, Weights kWeights>
  void pass(Step t, Purpose purpose, Particles<R>& to) {
    pass_.resize(to.size());
    const BlockShare& blocks = &to == &set_ ? blocks_of_set_ : blocks_of_proposals_;
    crew_.run(blocks.made.size(), [&](std::size_t share, std::size_t first, std::size_t last) {
      const lanes::SubnormalsAreZero fast;
      Desk& desk = desks_[share];
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t b = blocks.made[k];
        for (std::size_t d = 0; d < to.dimensions(); ++d) desk.to[d] = to.component(d).data() + b * kBlock;
        if constexpr (kSource == Source::kProposal)
          fetch_parents(desk, t, b);
        else if constexpr (kSource != Source::kPrior)
          for (std::size_t d = 0; d < to.dimensions(); ++d) std::copy_n(desk.to[d], pass_.size_of(b), desk.columns[d]);
        R* const logs = log_weights_.data() + b * kBlock;
        if constexpr (kWeights == Weights::kEqual) std::fill_n(logs, pass_.size_of(b), R(0));
        pass_.template start<kSource>(desk, address(t, purpose, b));
        pass_.template block<kSource, kWeights>(desk, b, t, desk.scratch.data() + kApart, logs);
      }
    });
    weighted_ = &to;
    for (const std::size_t b : blocks.left_out) pass_.leave_out(b);
    pass_.add_up();
    if (team_ != nullptr && &to == &set_) complete(set_, begins_of_shares(layout_.kept, share_.ranks));
  }

  /// Puts the parents of the proposals of block b on the desk, and draws what the chains decide on these by.
  void fetch_parents(Desk& desk, Step t, std::size_t b) {
    const Deal deal{address(t, Purpose::kParent, b), address(t, Purpose::kAccept, b), pass_.size_of(b),
                    static_cast<Index>(set_.size())};
    if (options_.parents == mote::Parents::kIid)
      return deal_out<true>(deal, set_, desk, log_uniforms_.data() + b * kBlock);
    const Permutation permutation(set_.size(), seed_ ^ mixed(static_cast<std::uint64_t>(t)));
    Index member = static_cast<Index>(b * kBlock % set_.size());
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
  /// Two numbers from anywhere, side by side: as whole numbers, which take ports that the generators leave free, and in
  /// one store where they fit.
  static MOTE_INLINE void copy_pair(const R* first, const R* second, R* to) {
    std::array<Number, 2> bits;
    std::memcpy(&bits[0], first, sizeof(R));
    std::memcpy(&bits[1], second, sizeof(R));
    if constexpr (sizeof(R) == 4) {
      const std::uint64_t both = bits[0] | std::uint64_t{bits[1]} << 32U;
      std::memcpy(to, &both, sizeof(both));
    } else {
      std::memcpy(to, bits.data(), sizeof(bits));
    }
  }
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
      lanes::unrolled<kWidth / 2>([&](std::size_t k) __attribute__((always_inline)) {
        const Index* const pair = parents + j + 2 * k;
        for (std::size_t d = 0; d < to.size(); ++d) copy_pair(from[d] + pair[0], from[d] + pair[1], to[d] + j + 2 * k);
      });
    }
  }

  /// Runs the chains over the proposals; the set is what they keep.
  ChainReport run_chains(std::span<const Index> starts) {
    const std::size_t chains = share_.end() - share_.first();
    const std::size_t groups = Chains::groups(chains);
    const std::size_t blocks = blocks_of_proposals_.made.size();
    auto from = column_pointers<const R, Pass::kD>(set_.dimensions());
    auto to = column_pointers<R, Pass::kD>(set_.dimensions());
    for (std::size_t d = 0; d < set_.dimensions(); ++d) {
      from[d] = proposals_.component(d).data();
      to[d] = set_.component(d).data();
    }
    for (Desk& desk : desks_) desk.chains = {};
    // shared out by the blocks' number, which says how much work there is
    crew_.run(blocks, [&](std::size_t share, std::size_t first, std::size_t last) {
      const lanes::SubnormalsAreZero fast;
      for (std::size_t g = groups * first / blocks; g < groups * last / blocks; ++g) {
        const ChainReport group = Chains(layout_, share_.first() + g * Chains::kLanes, share_.end(),
                                         log_weights_.data(), log_uniforms_.data(), starts)
                                      .run(from, to, std::span<R>(desks_[share].held));
        desks_[share].chains.offered += group.offered;
        desks_[share].chains.accepted += group.accepted;
      }
    });
    ChainReport all;
    for (const Desk& desk : desks_) {
      all.offered += desk.chains.offered;
      all.accepted += desk.chains.accepted;
    }
    return all;
  }

  /// As MetropolisFilter draws them: systematic by the weights of all proposals, dealt to the chains from a random one
  /// on.
  std::vector<Index> weighted_starts(Step t) {
    const Draws draws{seed_, static_cast<std::uint32_t>(t)};
    weigh_all();
    std::vector<Index> starts(layout_.chains);
    systematic(shown_, draws, starts);
    auto block = draws.block(Purpose::kStart);
    const std::size_t shift = block.particle(0).index(starts.size());
    std::rotate(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(shift), starts.end());
    if (team_ != nullptr) fetch_starts(starts);
    return starts;
  }
  /// The states that chains start from, wherever they were made.
  void fetch_starts(std::span<const Index> starts) {
    const std::size_t dimensions = proposals_.dimensions();
    std::vector<double> states(starts.size() * dimensions, -kInfinity);
    for (std::size_t k = 0; k < starts.size(); ++k)
      for (std::size_t d = 0; d < dimensions && share_.visits(share_.rank, starts[k]); ++d)
        states[k * dimensions + d] = static_cast<double>(proposals_.component(d)[starts[k]]);
    team_->largest(states);
    for (std::size_t k = share_.first(); k < share_.end(); ++k)
      for (std::size_t d = 0; d < dimensions; ++d)
        proposals_.component(d)[starts[k]] = static_cast<R>(states[k * dimensions + d]);
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
  Team* team_;
  ChainOptions options_;
  OnCollapse on_collapse_;
  ChainLayout layout_;
  ChainShare share_;
  std::size_t aimed_;  // N of the next proposals
  BlockShare blocks_of_set_, blocks_of_proposals_;
  Crew crew_;
  Particles<R> set_;                      // the unweighted set S_{t-1}
  mutable Particles<R> proposals_;        // of this step; what other ranks have is fetched when asked for
  mutable AlignedVector<R> log_weights_;  // of the proposals
  AlignedVector<R> log_uniforms_;         // what decides on them
  mutable Pass pass_;
  std::vector<Desk> desks_;
  bool complete_ = true;  // the set is on every rank as it is
  const Particles<R>* weighted_ = &set_;
  mutable std::vector<double> shown_;
  mutable AlignedVector<R> shown_block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote

#pragma once
/// The independent Metropolis-Hastings filter (IMH), which needs no resampling, and its auxiliary-variable form.

#include <algorithm>
#include <memory>
#include <optional>

#include "mote/base/permutation.hpp"
#include "mote/base/scan.hpp"
#include "mote/filter/chain.hpp"
#include "mote/filter/elastic.hpp"
#include "mote/filter/stages.hpp"
#include "mote/filter/still.hpp"
#include "mote/filter/weigh.hpp"

namespace mote {

/// Weight of a proposal by the mixtures over all parents; with g = p it is p(y | x).
///
///   w = p(y | x) sum_i p(x | x^i) / sum_i g(x | x^i, y)
///
/// cost    O(N) a proposal when g is not p
/// source  docs/filters.md (F12); IMH-HW (12), IMH-OPT (17)
struct MixtureWeight {
  template <class R, Model M, class G>
  static double log_ratio(const M& model, const G& proposal, Step t, const StateOf<M, R>& x, std::size_t,
                          const Particles<R>& parents, Rows<R> y) {
    if constexpr (std::is_same_v<G, Prior>) {
      return 0;
    } else {
      thread_local std::vector<double> scratch;
      scratch.resize(parents.size());
      auto before = blank_state<R>(model);
      const auto log_mixture = [&](auto&& density) {
        for (std::size_t i = 0; i < parents.size(); ++i) {
          parents.read(i, before);
          scratch[i] = static_cast<double>(density(before));
        }
        return log_sum_exp(scratch).log_sum;
      };
      const double p = log_mixture([&](const auto& b) { return model.template log_transition<R>(t, x, b); });
      return usable(p -
                    log_mixture([&](const auto& b) { return proposal.template log_density<R>(model, t, x, b, y); }));
    }
  }
};

/// Weight of a proposal x from parent k; the division by N makes its mean the evidence.
///
///   w = p(y | x) p(x | x^k) / (N g(k) g(x | x^k, y))
///
/// source  docs/filters.md (F20); IMH-OPT (23)
struct PairWeight {
  template <class R, Model M, class G>
  static double log_ratio(const M& model, const G& proposal, Step t, const StateOf<M, R>& x, std::size_t k,
                          const Particles<R>& parents, Rows<R> y) {
    auto before = blank_state<R>(model);
    parents.read(k, before);
    return log_importance<R>(model, proposal, t, x, before, y);
  }
};

/// The filter without resampling: proposals from the mixture of the parents, a Metropolis chain over them, its last N
/// states.
///
///   parents k ~ g(k), proposals x ~ g(. | x^k_{t-1}, y), Q + P N_b of them; weights by `Weight`
///   estimates sum w f(x) / sum w over all proposals; evidence = mean w
///   the chains' last N states are the unweighted set
///
/// The chains visit proposals as these are weighed. They wait for all weights where they start by them
/// (ChainStart::kWeighted), or burn in as long as the weights say.
///
/// shape   N kept, Q >= N drawn, P chains; `runner`, who runs the stages of a step, outlives the filter
/// cost    O(Q + P N_b) a step (times N for MixtureWeight with g not p); memory about (2 D + 4) 8 (Q + P N_b) bytes
/// source  docs/filters.md (F11) to (F20), (F27); IMH-HW section 4, IMH-OPT section IV
template <Model M, class R, class G, class Weight>
class MetropolisFilter final : public Filter, public Elastic {
 public:
  MetropolisFilter(M model, std::size_t particles, std::uint64_t seed, ChainOptions options, OnCollapse on_collapse,
                   StageRunner& runner = stage_by_stage())
      : model_(std::move(model)),
        proposal_(make_proposal<G>(model_)),
        seed_(seed),
        options_(options),
        on_collapse_(on_collapse),
        runner_(&runner),
        proposers_(runner.proposers() * runner.lines()),
        layout_{particles, options.draws == 0 ? particles : options.draws, options.chains, options.burn_in.value_or(0)},
        aimed_(particles),
        set_(model_.states().size(), particles),
        proposals_(model_.states().size(), 0),
        picks_(particles) {
    draw_prior(model_, set_, draws(0));
  }

  StepReport predict(Step t) override {
    const std::size_t words = words_of<R>(model_, Prior{}, t, some(), {});
    runner_->run({{0, set_.size()},
                  {{{0, set_.size()}}},
                  [&](std::size_t proposer, std::size_t line, Stretch stretch) {
                    Cursors& at = cursors(proposer, line);
                    at.moves.go(draws(t), Purpose::kMove, stretch.first, words);
                    move(model_, t, set_, at.moves, stretch.first, stretch.last);
                  },
                  {},
                  {}});
    return unweighted(set_);
  }

  StepReport update(Step t, Rows<double> rows) override {
    const auto y = rows_as<R>(rows);
    propose_all(t, y);
    return judged(t, y);
  }

  void select(Step t, StepReport& report) override {
    if (weighted_ == &set_) return;
    if (!chosen_) choose(t, report.collapsed);
    set_.resize(layout_.kept);
    set_.gather(proposals_, picks_);
    report.acceptance =
        chosen_->offered == 0 ? kNaN : static_cast<double>(chosen_->accepted) / static_cast<double>(chosen_->offered);
    report.burn_in = layout_.burn_in;
    report.selected = true;
  }

  WeightedSet weighted() const override { return {weighted_, weights_, total_}; }

  /// Chains then keep all that they draw.
  void aim(std::size_t particles) override { aimed_ = particles; }
  std::size_t weighed() const override { return weighted_->size(); }

  void keep(Archive& archive) override { archive(set_); }

  /// The unweighted set S_t, once selected.
  const Particles<R>& kept() const { return set_; }

 private:
  /// Whether proposals are parents that are moved where they are.
  static constexpr bool kMovesAll = std::is_same_v<G, Prior> && MovesAll<M, R>;
  static constexpr double kBurnInDistance = 0.01;  // total variation that `burn_in = auto` leaves

  Draws draws(Step t) const { return {seed_, static_cast<std::uint32_t>(t)}; }

  /// Systematic draws by the weights of all proposals, dealt to the chains from a random one on: in order, each chain
  /// would start in its own part of the cumulative sum, which depends on what that chain is about to visit.
  std::vector<Index> weighted_starts(Step t) const {
    std::vector<Index> starts(layout_.chains);
    systematic(weights_, draws(t), starts);
    auto block = draws(t).block(Purpose::kStart);
    const std::size_t shift = block.particle(0).index(starts.size());
    std::rotate(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(shift), starts.end());
    return starts;
  }

  /// Whether chains can visit proposals before all are weighed.
  bool chains_flow() const { return options_.start == ChainStart::kFirst && options_.burn_in; }

  void propose_all(Step t, Rows<R> y) {
    layout_.burn_in = options_.burn_in.value_or(0);
    if (aimed_ != layout_.kept) {
      layout_.kept = layout_.draws = aimed_;
      picks_.resize(aimed_);
    }
    prepare_parents(t, y);
    propose_stretch(t, y, {0, layout_.proposals()});
    if (options_.burn_in) return;
    layout_.burn_in = static_cast<std::size_t>(runner_->agreed([&] { return burn_in_by_weights(); }));
    propose_stretch(t, y, {layout_.draws, layout_.proposals()});
  }

  std::size_t burn_in_by_weights() const {
    const LogSum sum = log_sum_exp(log_weights_);
    if (!std::isfinite(sum.largest)) return 0;
    const double mean = std::exp(sum.log_sum - sum.largest) / static_cast<double>(layout_.draws);
    return burn_in_for(mean, 1, kBurnInDistance, layout_.draws);
  }

  /// Runs the stages over the proposals of a stretch; those before it stand. Draws are addressed by proposal.
  void propose_stretch(Step t, Rows<R> y, Stretch all) {
    proposals_.resize(all.last);
    log_weights_.resize(all.last);
    log_uniforms_.resize(all.last);
    weights_.resize(all.last);
    if constexpr (!std::is_same_v<G, Prior>) parents_.resize(all.last);
    if (all.size() == 0) return;
    const Permutation permutation(set_.size(), seed_ ^ mixed(static_cast<std::uint64_t>(t)));
    const std::size_t words = words_of<R>(model_, proposal_, t, some(), y);
    Chains chains(layout_, log_weights_, log_uniforms_, {}, picks_);
    Stages stages{all,
                  {{all}},
                  [&](std::size_t proposer, std::size_t line, Stretch stretch) {
                    propose(t, y, permutation, words, cursors(proposer, line), stretch);
                  },
                  [&](Stretch stretch) { weigh_stretch(t, y, stretch); },
                  {}};
    chosen_.reset();
    if (chains_flow()) {
      stages.lines = lines_of(layout_, runner_->lines());
      stages.take = [&](Stretch stretch) { chains.take(stretch.first, stretch.last); };
      stages.outcome = [&](std::size_t line) {
        const Cut of_line = chains_by_line(layout_, runner_->lines());
        const auto [at, picks] = chains.outcome(of_line.begin(line), of_line.begin(line + 1));
        return Memory{at, picks};
      };
    }
    stages.memory = [&](Stretch stretch) { return memory_of(stretch); };
    runner_->run(stages);
    if (chains_flow()) chosen_ = chains.report();
  }

  /// Where a proposer is in the draws.
  struct Cursors {
    DrawCursor<R> parents, moves, accepts;
    DrawCursor<double> lookaheads;
  };
  Cursors& cursors(std::size_t proposer, std::size_t line) { return proposers_[proposer * runner_->lines() + line]; }
  StateOf<M, R> some() const {
    auto x = blank_state<R>(model_);
    set_.read(0, x);
    return x;
  }

  /// Draws all that is drawn of a stretch of proposals: parents, states, what the chains decide by.
  void propose(Step t, Rows<R> y, const Permutation& permutation, std::size_t words, Cursors& at, Stretch stretch) {
    if (lookahead_)
      at.lookaheads.go(draws(t), Purpose::kParent, stretch.first, 1);
    else if (options_.parents == Parents::kIid)
      at.parents.go(draws(t), Purpose::kParent, stretch.first, 1);
    at.moves.go(draws(t), Purpose::kMove, stretch.first, words);
    at.accepts.go(draws(t), Purpose::kAccept, stretch.first, 1);
    auto before = blank_state<R>(model_);
    for (std::size_t j = stretch.first; j < stretch.last; ++j) {
      const auto [k, log_parent] = parent_of(j, permutation, at);
      set_.read(k, before);
      if constexpr (kMovesAll) {
        proposals_.write(j, before);
      } else {
        auto draw = at.moves.next();
        proposals_.write(j, proposal_.template propose<R>(model_, t, before, y, draw));
      }
      if constexpr (!std::is_same_v<G, Prior>) parents_[j] = static_cast<Index>(k);
      log_weights_[j] = -log_parent;
      log_uniforms_[j] = std::log(static_cast<double>(at.accepts.next().uniform()));
    }
    if constexpr (kMovesAll) move(model_, t, proposals_, at.moves, stretch.first, stretch.last);
  }

  void weigh_stretch(Step t, Rows<R> y, Stretch stretch) {
    if constexpr (!std::is_same_v<G, Prior>) {
      auto x = blank_state<R>(model_);
      for (std::size_t j = stretch.first; j < stretch.last; ++j) {
        proposals_.read(j, x);
        log_weights_[j] += Weight::template log_ratio<R>(model_, proposal_, t, x, parents_[j], set_, y);
      }
    }
    weigh<M, R>(model_, t, y, proposals_, log_weights_, stretch.first, stretch.last);
  }

  /// All that is known of a stretch of proposals.
  Memory memory_of(Stretch stretch) {
    Memory memory;
    add_columns(memory, proposals_, stretch);
    add_column(memory, std::span(log_weights_), stretch);
    add_column(memory, std::span(log_uniforms_), stretch);
    if constexpr (!std::is_same_v<G, Prior>) add_column(memory, std::span(parents_), stretch);
    return memory;
  }

  /// Runs the chains over all proposals at once.
  void choose(Step t, bool collapsed) {
    const auto starts =
        options_.start == ChainStart::kWeighted && !collapsed ? weighted_starts(t) : std::vector<Index>{};
    chosen_ = run_chains(layout_, log_weights_, log_uniforms_, starts, picks_);
  }

  struct Parent {
    std::size_t index;
    double log_weight;  // log (N g(k))
  };
  Parent parent_of(std::size_t j, const Permutation& permutation, Cursors& at) const {
    if (lookahead_) return looked_ahead(at.lookaheads.next());
    const std::size_t n = set_.size();
    switch (options_.parents) {
      case Parents::kPermuted:
        return {permutation(j % n), 0};
      case Parents::kSweep:
        return {j % n, 0};
      case Parents::kIid:
        break;
    }
    return {at.parents.next().index(n), 0};
  }
  Parent looked_ahead(Draw<double> draw) const {
    const std::size_t k = lookahead_->find(draw.uniform() * lookahead_->total());
    return {k, std::log(lookahead_->weights()[k] / lookahead_->total() * static_cast<double>(set_.size()))};
  }

  /// g(k) for the auxiliary filter: half uniform, half the likelihood of the parent moved with its noise at the median;
  /// docs/filters.md (F21).
  void prepare_parents(Step t, Rows<R> y) {
    if (options_.parent_weights == ParentWeights::kUniform) return;
    StillDraw<R> still;
    const std::size_t n = set_.size();
    parent_weights_.resize(n);
    auto before = blank_state<R>(model_);
    for (std::size_t i = 0; i < n; ++i) {
      set_.read(i, before);
      parent_weights_[i] = log_likelihood<R>(model_, t, model_.template next<R>(t, before, still), y);
    }
    const LogSum sum = log_sum_exp(parent_weights_);
    for (double& w : parent_weights_)
      w = 0.5 / static_cast<double>(n) + (std::isfinite(sum.largest) ? 0.5 * std::exp(w - sum.log_sum) : 0);
    lookahead_.emplace(parent_weights_);
  }

  StepReport judged(Step t, Rows<R> y) {
    StepReport report;
    Judgement judgement = judge(log_weights_, weights_);
    if (judgement.collapsed) {
      report.collapsed = true;
      chosen_.reset();
      if (on_collapse_ == OnCollapse::kReset) {
        draw_prior(model_, proposals_, draws(t), Purpose::kReset);
        std::fill(log_weights_.begin(), log_weights_.end(), 0.0);
        weigh<M, R>(model_, t, y, proposals_, log_weights_);
        judgement = judge(log_weights_, weights_);
      }
      if (judgement.collapsed) std::fill(log_weights_.begin(), log_weights_.end(), 0.0);
      judgement = judge(log_weights_, weights_);
    }
    weighted_ = &proposals_;
    total_ = judgement.total;
    report.ess = judgement.ess;
    report.log_evidence = report.collapsed ? -kInfinity : judgement.log_sum + log_mean_share();
    return report;
  }

  /// log of the mean weight over the sum of all. With `burn_in = auto` the mean is over the Q alone: how many more were
  /// drawn depends on their weights, and a mean stopped by its own terms is biased.
  double log_mean_share() const {
    const std::size_t n = options_.burn_in ? weights_.size() : layout_.draws;
    return std::log(ordered_sum(n, [&](std::size_t j) { return weights_[j]; }) / total_ / static_cast<double>(n));
  }

  StepReport unweighted(const Particles<R>& x) {
    weighted_ = &x;
    weights_.assign(x.size(), 1.0);
    total_ = static_cast<double>(x.size());
    StepReport report;
    report.ess = total_;
    return report;
  }

  M model_;
  G proposal_;
  std::uint64_t seed_;
  ChainOptions options_;
  OnCollapse on_collapse_;
  StageRunner* runner_;
  std::vector<Cursors> proposers_;  // one a proposer and line
  ChainLayout layout_;
  std::size_t aimed_;             // N of the next proposals
  Particles<R> set_, proposals_;  // the unweighted set S_{t-1}; the proposals of this step
  std::vector<double> log_weights_, log_uniforms_, weights_;
  std::vector<Index> parents_;  // of the proposals, where their weights depend on them
  std::vector<Index> picks_;
  std::optional<ChainReport> chosen_;  // what the chains did, if they have picked
  std::vector<double> parent_weights_;
  std::optional<WeightScan> lookahead_;
  const Particles<R>* weighted_ = &set_;
  double total_ = 0;
};

/// The IMH filter with the mixture weights of IMH-HW (12).
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_imh(M model, std::size_t particles, std::uint64_t seed, const ChainOptions& options = {},
                                 OnCollapse on_collapse = OnCollapse::kStop, StageRunner& runner = stage_by_stage()) {
  return std::make_unique<MetropolisFilter<M, R, G, MixtureWeight>>(std::move(model), particles, seed, options,
                                                                    on_collapse, runner);
}

/// The auxiliary-variable IMH filter: pairs (x, k), any proposal, no sum over parents.
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_auxiliary(M model, std::size_t particles, std::uint64_t seed,
                                       const ChainOptions& options = {}, OnCollapse on_collapse = OnCollapse::kStop,
                                       StageRunner& runner = stage_by_stage()) {
  return std::make_unique<MetropolisFilter<M, R, G, PairWeight>>(std::move(model), particles, seed, options,
                                                                 on_collapse, runner);
}

}  // namespace mote

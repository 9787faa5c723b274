#pragma once
/// The independent Metropolis-Hastings filter (IMH), which needs no resampling, and its auxiliary-variable form.

#include <algorithm>
#include <memory>

#include "mote/base/permutation.hpp"
#include "mote/base/scan.hpp"
#include "mote/filter/chain.hpp"
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
                          const Particles<R>& parents, Rows<R> y, std::span<double> scratch) {
    if constexpr (std::is_same_v<G, Prior>) {
      return 0;
    } else {
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
                          const Particles<R>& parents, Rows<R> y, std::span<double>) {
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
/// shape   N kept, Q >= N drawn, P chains
/// cost    O(Q + P N_b) a step (times N for MixtureWeight with g not p); memory about (2 D + 3) 8 (Q + P N_b) bytes
/// source  docs/filters.md (F11) to (F20), (F27); IMH-HW section 4, IMH-OPT section IV
template <Model M, class R, class G, class Weight>
class MetropolisFilter final : public Filter {
 public:
  MetropolisFilter(M model, std::size_t particles, std::uint64_t seed, ChainOptions options, OnCollapse on_collapse)
      : model_(std::move(model)),
        proposal_(make_proposal<G>(model_)),
        seed_(seed),
        options_(options),
        on_collapse_(on_collapse),
        layout_{particles, options.draws == 0 ? particles : options.draws, options.chains, options.burn_in.value_or(0)},
        set_(model_.states().size(), particles),
        proposals_(model_.states().size(), 0),
        picks_(particles) {
    draw_prior(model_, set_, draws(0));
  }

  StepReport predict(Step t) override {
    move(model_, t, set_, draws(t));
    return unweighted(set_);
  }

  StepReport update(Step t, Rows<double> rows) override {
    const auto y = rows_as<R>(rows);
    propose_all(t, y);
    return judged(t, y);
  }

  void select(Step t, StepReport& report) override {
    if (weighted_ == &set_) return;
    std::vector<Index> starts;
    if (options_.start == ChainStart::kWeighted && !report.collapsed) {
      starts = weighted_starts(t);
    }
    // the linear weights have served: their place takes the log uniforms
    draws(t).template for_each<R>(Purpose::kAccept, 0, weights_.size(), [&](std::size_t j, auto& draw) {
      weights_[j] = std::log(static_cast<double>(draw.uniform()));
    });
    const ChainReport chain = run_chains(layout_, log_weights_, weights_, starts, picks_);
    set_.gather(proposals_, picks_);
    report.acceptance =
        chain.offered == 0 ? kNaN : static_cast<double>(chain.accepted) / static_cast<double>(chain.offered);
    report.burn_in = layout_.burn_in;
    report.selected = true;
  }

  WeightedSet weighted() const override { return {weighted_, weights_, total_}; }

  void keep(Archive& archive) override { archive(set_); }

 private:
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

  void propose_all(Step t, Rows<R> y) {
    layout_.burn_in = options_.burn_in.value_or(0);
    prepare_parents(t, y);
    propose_range(t, y, 0, layout_.proposals());
    if (options_.burn_in) return;
    const LogSum sum = log_sum_exp(log_weights_);
    if (!std::isfinite(sum.largest)) return;
    const double mean = std::exp(sum.log_sum - sum.largest) / static_cast<double>(layout_.draws);
    layout_.burn_in = burn_in_for(mean, 1, kBurnInDistance, layout_.draws);
    propose_range(t, y, layout_.draws, layout_.proposals());
  }

  /// Proposes and weighs proposals [from, to); those before `from` stand. Draws are addressed by proposal.
  void propose_range(Step t, Rows<R> y, std::size_t from, std::size_t to) {
    proposals_.resize(to);
    log_weights_.resize(to);
    weights_.resize(to);
    std::vector<double> scratch(std::is_same_v<G, Prior> ? 0 : set_.size());
    const Permutation permutation(set_.size(), seed_ ^ mixed(static_cast<std::uint64_t>(t)));
    auto before = blank_state<R>(model_);
    const std::size_t n = set_.size();
    for (std::size_t start = from / kBlock * kBlock; start < to; start += kBlock) {
      auto parents = draws(t).template block<R>(Purpose::kParent, start / kBlock);
      auto lookahead = draws(t).block(Purpose::kParent, start / kBlock);
      auto moves = draws(t).template block<R>(Purpose::kMove, start / kBlock);
      for (std::size_t j = start; j < std::min(start + kBlock, to); ++j) {
        auto draw = moves.particle(j - start);
        const auto [k, log_parent] = lookahead_
                                         ? looked_ahead(n, lookahead.particle(j - start))
                                         : Parent{uniform_parent(j, n, permutation, parents.particle(j - start)), 0};
        set_.read(k, before);
        const auto x = proposal_.template propose<R>(model_, t, before, y, draw);
        if (j < from) continue;  // drawn again only to keep the block's stream in step
        proposals_.write(j, x);
        log_weights_[j] = Weight::template log_ratio<R>(model_, proposal_, t, x, k, set_, y, scratch) - log_parent;
      }
    }
    weigh<M, R>(model_, t, y, proposals_, log_weights_, from);
  }

  struct Parent {
    std::size_t index;
    double log_weight;  // log (N g(k))
  };
  Parent looked_ahead(std::size_t n, Draw<double> draw) const {
    const std::size_t k = lookahead_->find(draw.uniform() * lookahead_->total());
    return {k, std::log(lookahead_->weights()[k] / lookahead_->total() * static_cast<double>(n))};
  }
  std::size_t uniform_parent(std::size_t j, std::size_t n, const Permutation& permutation, Draw<R> draw) const {
    switch (options_.parents) {
      case Parents::kPermuted:
        return permutation(j % n);
      case Parents::kSweep:
        return j % n;
      case Parents::kIid:
        break;
    }
    return draw.index(n);
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
    Judgement judgement = normalise(log_weights_, weights_);
    if (judgement.collapsed) {
      report.collapsed = true;
      if (on_collapse_ == OnCollapse::kReset) {
        draw_prior(model_, proposals_, draws(t), Purpose::kReset);
        std::fill(log_weights_.begin(), log_weights_.end(), 0.0);
        weigh<M, R>(model_, t, y, proposals_, log_weights_);
        judgement = normalise(log_weights_, weights_);
      }
      if (judgement.collapsed) std::fill(log_weights_.begin(), log_weights_.end(), 0.0);
      judgement = normalise(log_weights_, weights_);
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
  ChainLayout layout_;
  Particles<R> set_, proposals_;  // the unweighted set S_{t-1}; the proposals of this step
  std::vector<double> log_weights_, weights_;
  std::vector<Index> picks_;
  std::vector<double> parent_weights_;
  std::optional<WeightScan> lookahead_;
  const Particles<R>* weighted_ = &set_;
  double total_ = 0;
};

/// The IMH filter with the mixture weights of IMH-HW (12).
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_imh(M model, std::size_t particles, std::uint64_t seed, const ChainOptions& options = {},
                                 OnCollapse on_collapse = OnCollapse::kStop) {
  return std::make_unique<MetropolisFilter<M, R, G, MixtureWeight>>(std::move(model), particles, seed, options,
                                                                    on_collapse);
}

/// The auxiliary-variable IMH filter: pairs (x, k), any proposal, no sum over parents.
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_auxiliary(M model, std::size_t particles, std::uint64_t seed,
                                       const ChainOptions& options = {}, OnCollapse on_collapse = OnCollapse::kStop) {
  return std::make_unique<MetropolisFilter<M, R, G, PairWeight>>(std::move(model), particles, seed, options,
                                                                 on_collapse);
}

}  // namespace mote

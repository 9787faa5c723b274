#pragma once
/// The selectors of the distributed filter: inside groups, with exchange, or over all of them.

#include <memory>
#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/base/permutation.hpp"
#include "mote/filter/chain.hpp"
#include "mote/filter/exchange.hpp"
#include "mote/filter/select.hpp"

namespace mote {

/// The draws of one group; K, one past the last, is what all groups draw together.
inline Draws stream_of(Draws draws, std::size_t group) {
  draws.stream = static_cast<std::uint32_t>(group);
  return draws;
}

/// How many groups of equal weight would be as good as these: (sum m)^2 / sum m^2.
///
/// source  docs/filters.md (F24b)
inline double effective_groups(std::span<const double> log_weights, const Membership& members) {
  double sum = 0;
  double squares = 0;
  for (const double mass : members.of_all(members.by_group([&](std::size_t first, std::size_t n) {
         return std::exp(log_sum_exp(log_weights.subspan(first, n)).log_sum);
       }))) {
    sum += mass;
    squares += mass * mass;
  }
  return sum * sum / squares;
}

/// Ancestors by a Metropolis chain that visits every particle once, in random order, from a start drawn by weight: IMH
/// (F13) whose parents have had one proposal each.
///
/// shape   weights: (n,), linear, not all zero; ancestors: (N,), N <= n
/// error   none; the numbers of children have the means N w_i / sum w up to the chain's length only
/// source  docs/filters.md (F24d)
inline void visit_all(std::span<const double> weights, const Draws& draws, std::span<Index> ancestors) {
  const std::size_t n = weights.size();
  const Permutation order(n, draws.seed ^ mixed((std::uint64_t{draws.step} << 32U) + draws.stream));
  std::vector<double> visited(n);
  for (std::size_t j = 0; j < n; ++j) visited[j] = weights[order(j)];
  std::vector<Index> start(1);
  systematic(visited, draws, start);
  std::vector<double> log_uniforms(n);
  draws.for_each(Purpose::kAccept, 0, n,
                 [&](std::size_t j, auto& draw) { log_uniforms[j] = std::log(draw.uniform()); });
  for (double& w : visited) w = std::log(w);
  run_chains({.kept = ancestors.size(), .draws = n, .chains = 1, .burn_in = 0}, visited, log_uniforms, start,
             ancestors);
  for (Index& a : ancestors) a = static_cast<Index>(order(a));
}

/// Local selection: resamples inside each group, or runs a chain there, after an exchange (append, replace, swap) or
/// before one (RNA).
///
/// Group weights are carried (properly weighted, evidence unbiased but for replace) or reset at each resampling.
///
/// source  docs/filters.md (F22) to (F24d); PPF fig. 3.4
template <class R>
class GroupSelector final : public Selector<R> {
 public:
  GroupSelector(const SelectionOptions& selection, const GroupOptions& groups) : options_(selection), groups_(groups) {}

  Selected select(Cloud<R>& cloud, double, const Draws& draws) override {
    const Membership& members = *cloud.members;
    Selected done;
    const bool due = exchange_is_due(cloud, draws.step, done.traffic);
    const std::size_t turn = draws.step / groups_.exchange_every;
    const bool after = groups_.resampling == GroupResampling::kNonProportional;
    Inbox<R> inbox;
    if (due && !after) inbox = receive(cloud, turn);
    std::vector<double> selected;
    for (std::size_t k = members.begin(); k < members.end(); ++k)
      selected.push_back(select_group(cloud, members.first(k), members.size(k), inbox, k, draws) ? 1 : 0);
    done.any = members.largest(std::move(selected)) > 0;
    if (!groups_.carry_group_weights && !after && done.any) reset(cloud);
    if (due && after) trade_evenly(cloud.x, cloud.log_weights, members, groups_, turn);
    if (due) done.traffic += exchanged<R>(groups_, cloud.x.dimensions());
    return done;
  }

 private:
  /// Whether this step exchanges; asking the groups for their weights is traffic.
  bool exchange_is_due(const Cloud<R>& cloud, std::size_t step, Traffic& traffic) const {
    if (!groups_.exchanges() || step % groups_.exchange_every != 0) return false;
    if (groups_.exchange_when >= 1) return true;
    traffic += all_gathered(groups_.groups, sizeof(double));
    return effective_groups(cloud.log_weights, *cloud.members) <=
           groups_.exchange_when * static_cast<double>(groups_.groups);
  }

  Inbox<R> receive(Cloud<R>& cloud, std::size_t turn) const {
    Inbox<R> inbox = send(cloud.x, cloud.log_weights, *cloud.members, groups_, turn);
    if (groups_.exchange == Exchange::kReplace) share_out_what_was_lost(cloud.log_weights, *cloud.members);
    return inbox;
  }

  /// The weight of replaced particles goes to all others in proportion.
  static void share_out_what_was_lost(std::span<double> log_weights, const Membership& members) {
    const std::vector<double> masses = members.of_all(members.by_group(
        [&](std::size_t first, std::size_t n) { return log_sum_exp(log_weights.subspan(first, n)).log_sum; }));
    const double left = log_sum_exp(masses).log_sum;
    if (!std::isfinite(left)) return;
    for (double& l : log_weights) l -= left;
  }

  bool select_group(Cloud<R>& cloud, std::size_t first, std::size_t n, const Inbox<R>& inbox, std::size_t k,
                    const Draws& draws) {
    if (inbox.count > 0) return select_appended(cloud, first, n, inbox, k, draws);
    const std::span<double> logs(cloud.log_weights.data() + first, n);
    const std::span<double> weights(cloud.weights.data() + first, n);
    const LogSum mass = log_sum_exp(logs);
    if (!std::isfinite(mass.largest)) return false;  // a group without weight waits for its neighbours
    exponentiate(logs, mass.largest, weights);
    if (effective_sample_size(weights) > options_.ess_threshold * static_cast<double>(n)) return false;
    std::vector<Index> ancestors = survivors(weights, logs, mass.log_sum, stream_of(draws, k));
    for (Index& a : ancestors) a += static_cast<Index>(first);
    cloud.x.gather(ancestors, first);
    return true;
  }

  /// Own particles and received ones compete for the group's n places, whatever the effective sample size: n + M must
  /// become n again.
  bool select_appended(Cloud<R>& cloud, std::size_t first, std::size_t n, const Inbox<R>& inbox, std::size_t k,
                       const Draws& draws) {
    const std::size_t m = inbox.count;
    const std::size_t place = (k - cloud.members->begin()) * m;
    Cloud<R> both(cloud.x.dimensions(), n + m);
    for (std::size_t d = 0; d < cloud.x.dimensions(); ++d) {
      std::copy_n(cloud.x.component(d).begin() + static_cast<std::ptrdiff_t>(first), n, both.x.component(d).begin());
      std::copy_n(inbox.x.component(d).begin() + static_cast<std::ptrdiff_t>(place), m,
                  both.x.component(d).begin() + static_cast<std::ptrdiff_t>(n));
    }
    std::copy_n(cloud.log_weights.begin() + static_cast<std::ptrdiff_t>(first), n, both.log_weights.begin());
    std::copy_n(inbox.log_weights.begin() + static_cast<std::ptrdiff_t>(place), m,
                both.log_weights.begin() + static_cast<std::ptrdiff_t>(n));
    const LogSum mass = log_sum_exp(both.log_weights);
    if (!std::isfinite(mass.largest)) return false;
    exponentiate(both.log_weights, mass.largest, both.weights);
    const std::span<double> logs(cloud.log_weights.data() + first, n);
    const std::vector<Index> ancestors = survivors(both.weights, logs, mass.log_sum, stream_of(draws, k));
    for (std::size_t d = 0; d < cloud.x.dimensions(); ++d)
      for (std::size_t j = 0; j < n; ++j) cloud.x.component(d)[first + j] = both.x.component(d)[ancestors[j]];
    return true;
  }

  std::vector<Index> survivors(std::span<double> weights, std::span<double> log_weights, double log_mass,
                               const Draws& draws) const {
    if (groups_.resampling != GroupResampling::kChain)
      return draw_survivors(weights, log_weights, log_mass, options_, draws);
    return draw_survivors_by(
        weights, log_weights, log_mass, 1,
        [&](std::span<const double> by, std::span<Index> ancestors) { visit_all(by, draws, ancestors); });
  }

  /// Every group gets the weight n_k / N again, whatever its particles explained.
  static void reset(Cloud<R>& cloud) {
    const Membership& members = *cloud.members;
    const double all = std::log(static_cast<double>(cloud.all()));
    for (std::size_t k = members.begin(); k < members.end(); ++k) {
      const std::span<double> logs(cloud.log_weights.data() + members.first(k), members.size(k));
      const double mass = log_sum_exp(logs).log_sum;
      const double share = std::log(static_cast<double>(members.size(k))) - all;
      for (double& l : logs) l = std::isfinite(mass) ? l - mass + share : -all;
    }
  }

  SelectionOptions options_;
  GroupOptions groups_;
};

/// Ancestors by proportional allocation: how many children each group's particles have together, then which.
///
///   N_k = children of group k,  E N_k = N W_k;   N_k children inside the group,  E n_i = N_k w_i / W_k
///
/// A group keeps its own children as far as it has places; what is left over fills the other groups' places in order.
///
/// shape   weights: linear, not all zero; ancestors: (N,)
/// source  docs/filters.md (F24e); Bolic, Djuric & Hong 2005, RPA
inline void allocate(std::span<const double> weights, const Groups& groups, const Scheme& scheme, const Draws& draws,
                     std::span<Index> ancestors) {
  std::vector<double> sums;
  for (std::size_t k = 0; k < groups.count(); ++k)
    sums.push_back(ordered_sum(groups.size(k), [&](std::size_t i) { return weights[groups.first(k) + i]; }));
  std::vector<Index> families(ancestors.size());
  scheme.resample(sums, stream_of(draws, groups.count()), families);
  std::vector<std::vector<Index>> children(groups.count());
  for (const Index k : families) children[k].push_back(0);
  std::vector<Index> surplus;
  for (std::size_t k = 0; k < groups.count(); ++k) {
    const std::size_t first = groups.first(k);
    if (children[k].empty()) continue;
    scheme.resample(weights.subspan(first, groups.size(k)), stream_of(draws, k), children[k]);
    for (Index& a : children[k]) a += static_cast<Index>(first);
    const std::size_t kept = std::min(children[k].size(), groups.size(k));
    std::copy_n(children[k].begin(), kept, ancestors.begin() + static_cast<std::ptrdiff_t>(first));
    surplus.insert(surplus.end(), children[k].begin() + static_cast<std::ptrdiff_t>(kept), children[k].end());
  }
  auto next = surplus.begin();
  for (std::size_t k = 0; k < groups.count(); ++k)
    for (std::size_t j = children[k].size(); j < groups.size(k); ++j) ancestors[groups.first(k) + j] = *next++;
}

/// What it sends that children are born in other groups than their parents': `bytes` each, and one message between any
/// two groups.
inline Traffic moved(std::span<const Index> ancestors, const Groups& groups, double bytes) {
  Traffic traffic;
  std::vector<bool> met(groups.count() * groups.count());
  for (std::size_t k = 0; k < groups.count(); ++k)
    for (std::size_t j = 0; j < groups.size(k); ++j) {
      const std::size_t from = groups.of(ancestors[groups.first(k) + j]);
      if (from == k) continue;
      traffic.bytes += bytes;
      if (!met[from * groups.count() + k]) traffic.messages += 1;
      met[from * groups.count() + k] = true;
    }
  return traffic;
}

/// Selection over all groups: in one piece, which is SISR, or by proportional allocation.
///
/// source  docs/filters.md (F9), (F24e)
template <class R>
class JointSelector final : public Selector<R> {
 public:
  JointSelector(const SelectionOptions& selection, const GroupOptions& groups) : options_(selection), groups_(groups) {}

  Selected select(Cloud<R>& cloud, double ess, const Draws& draws) override {
    const Groups groups(cloud.size(), groups_.groups);
    // sums of the weights, and of their squares where the effective sample size decides
    Selected done{.any = false, .traffic = all_gathered(groups.count(), options_.ess_threshold < 1 ? 16 : 8)};
    if (ess > options_.ess_threshold * static_cast<double>(cloud.size())) return done;
    const std::vector<Index> ancestors =
        draw_survivors_by(cloud.weights, cloud.log_weights, 0.0, options_.exponent,
                          [&](std::span<const double> weights, std::span<Index> chosen) {
                            if (groups_.resampling == GroupResampling::kProportional && groups.count() > 1)
                              allocate(weights, groups, *options_.scheme, draws, chosen);
                            else
                              options_.scheme->resample(weights, draws, chosen);
                          });
    cloud.x.gather(ancestors);
    const std::size_t weight = options_.exponent == 1 ? 0 : sizeof(double);  // else all weigh the same
    done.traffic += moved(ancestors, groups, static_cast<double>(cloud.x.dimensions() * sizeof(R) + weight));
    done.any = true;
    return done;
  }

 private:
  SelectionOptions options_;
  GroupOptions groups_;
};

/// The selector that the options ask for.
template <class R>
std::unique_ptr<Selector<R>> make_group_selector(const SelectionOptions& selection, const GroupOptions& groups) {
  if (groups.joint()) return std::make_unique<JointSelector<R>>(selection, groups);
  return std::make_unique<GroupSelector<R>>(selection, groups);
}

}  // namespace mote

#pragma once
/// Select: the set that the next step starts from, for filters with importance weights.

#include <memory>
#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/filter/exchange.hpp"
#include "mote/filter/options.hpp"
#include "mote/filter/particles.hpp"

namespace mote {

/// The weighted cloud of an importance filter. Carried log weights have log-sum-exp 0 (in the mean, with w / a
/// selection).
template <class R>
struct Cloud {
  Particles<R> x;
  std::vector<double> log_weights;  // (N,) normalised
  std::vector<double> weights;      // (N,) linear, scratch between update and select

  Cloud(std::size_t dimensions, std::size_t n) : x(dimensions, n), log_weights(n), weights(n) { spread(); }
  std::size_t size() const { return x.size(); }
  /// All particles weigh the same.
  void spread() {
    std::fill(log_weights.begin(), log_weights.end(), -std::log(static_cast<double>(size())));
    std::fill(weights.begin(), weights.end(), 1.0);
  }
};

/// Draws log_weights.size() ancestors and writes the log weights that they carry, `mass` in all (in the mean).
///
///   a_i ~ w_i^exponent;  survivor j carries  mass * (W_J / A_J) / n   (equal weights when exponent = 1)
///
/// shape   weights: linear, overwritten; not all zero. log_weights: (n,)
/// source  IMH-OPT II-B
inline std::vector<Index> draw_survivors(std::span<double> weights, std::span<double> log_weights, double log_mass,
                                         const SelectionOptions& options, const Draws& draws) {
  const bool plain = options.exponent == 1;
  const auto sum = [&] { return ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; }); };
  const double total = sum();
  if (!plain)
    for (double& w : weights) w = w > 0 ? std::pow(w, options.exponent) : 0;
  std::vector<Index> ancestors(log_weights.size());
  options.scheme->resample(weights, draws, ancestors);
  const double spread = log_mass - std::log(static_cast<double>(log_weights.size()));
  std::fill(log_weights.begin(), log_weights.end(), spread);
  if (plain) return ancestors;
  const double selection = sum();
  for (double& w : weights) w = std::pow(w, 1 / options.exponent - 1);  // w / a of the particle, up to the totals
  for (std::size_t j = 0; j < ancestors.size(); ++j)
    log_weights[j] = spread + std::log(weights[ancestors[j]] * selection / total);
  return ancestors;
}

/// Replaces particles [first, first + n) by n draws among them and leaves `mass` spread over them.
///
/// shape   cloud.weights: linear, those of [first, first + n) not all zero; overwritten
template <class R>
void resample(Cloud<R>& cloud, std::size_t first, std::size_t n, double log_mass, const SelectionOptions& options,
              const Draws& draws) {
  const auto part = [&](std::vector<double>& all) { return std::span<double>(all).subspan(first, n); };
  std::vector<Index> ancestors = draw_survivors(part(cloud.weights), part(cloud.log_weights), log_mass, options, draws);
  for (Index& a : ancestors) a += static_cast<Index>(first);
  cloud.x.gather(ancestors, first);
}

/// How an importance filter selects.
template <class R>
class Selector {
 public:
  virtual ~Selector() = default;
  /// Selects where the options ask for it; true if anything was resampled.
  virtual bool select(Cloud<R>& cloud, double ess, const Draws& draws) = 0;
};

/// SISR: resamples the whole set when its effective sample size is low; docs/filters.md (F8).
template <class R>
class WholeSelector final : public Selector<R> {
 public:
  explicit WholeSelector(const SelectionOptions& options) : options_(options) {}

  bool select(Cloud<R>& cloud, double ess, const Draws& draws) override {
    if (ess > options_.ess_threshold * static_cast<double>(cloud.size())) return false;
    resample(cloud, 0, cloud.size(), 0.0, options_, draws);
    return true;
  }

 private:
  SelectionOptions options_;
};

/// The distributed filter: exchanges particles between neighbouring groups, then resamples inside each group.
///
/// Group weights are carried (properly weighted, evidence unbiased but for replace) or reset at each resampling.
///
/// source  docs/filters.md (F22) to (F24); PPF fig. 3.4
template <class R>
class GroupSelector final : public Selector<R> {
 public:
  GroupSelector(const SelectionOptions& selection, const GroupOptions& groups) : options_(selection), groups_(groups) {}

  bool select(Cloud<R>& cloud, double, const Draws& draws) override {
    const std::size_t n = cloud.size();
    const Ring ring(n, groups_.groups);
    const Inbox<R> inbox = send(cloud.x, cloud.log_weights, ring, groups_);
    if (groups_.exchange == Exchange::kReplace) share_out_what_was_lost(cloud.log_weights);
    bool any = false;
    for (std::size_t k = 0; k < ring.groups(); ++k)
      any = select_group(cloud, ring.first(k), ring.size(k), inbox, k, draws) || any;
    if (!groups_.carry_group_weights && any) reset(cloud, ring);
    return any;
  }

 private:
  /// The weight of replaced particles goes to all others in proportion.
  static void share_out_what_was_lost(std::span<double> log_weights) {
    const double left = log_sum_exp(log_weights).log_sum;
    if (!std::isfinite(left)) return;
    for (double& l : log_weights) l -= left;
  }

  bool select_group(Cloud<R>& cloud, std::size_t first, std::size_t n, const Inbox<R>& inbox, std::size_t k,
                    const Draws& draws) {
    if (groups_.exchange == Exchange::kAppend && groups_.groups > 1)
      return select_appended(cloud, first, n, inbox, k, draws);
    const std::span<double> logs(cloud.log_weights.data() + first, n);
    const std::span<double> weights(cloud.weights.data() + first, n);
    const LogSum mass = log_sum_exp(logs);
    if (!std::isfinite(mass.largest)) return false;  // a group without weight waits for its neighbours
    exponentiate(logs, mass.largest, weights);
    if (effective_sample_size(weights) > options_.ess_threshold * static_cast<double>(n)) return false;
    resample(cloud, first, n, mass.log_sum, options_, stream(draws, k));
    return true;
  }

  /// Own particles and received ones compete for the group's n places, whatever the effective sample size: n + M must
  /// become n again.
  bool select_appended(Cloud<R>& cloud, std::size_t first, std::size_t n, const Inbox<R>& inbox, std::size_t k,
                       const Draws& draws) {
    const std::size_t m = inbox.count;
    Cloud<R> both(cloud.x.dimensions(), n + m);
    for (std::size_t d = 0; d < cloud.x.dimensions(); ++d) {
      std::copy_n(cloud.x.component(d).begin() + static_cast<std::ptrdiff_t>(first), n, both.x.component(d).begin());
      std::copy_n(inbox.x.component(d).begin() + static_cast<std::ptrdiff_t>(k * m), m,
                  both.x.component(d).begin() + static_cast<std::ptrdiff_t>(n));
    }
    std::copy_n(cloud.log_weights.begin() + static_cast<std::ptrdiff_t>(first), n, both.log_weights.begin());
    std::copy_n(inbox.log_weights.begin() + static_cast<std::ptrdiff_t>(k * m), m,
                both.log_weights.begin() + static_cast<std::ptrdiff_t>(n));
    const LogSum mass = log_sum_exp(both.log_weights);
    if (!std::isfinite(mass.largest)) return false;
    exponentiate(both.log_weights, mass.largest, both.weights);
    const std::span<double> logs(cloud.log_weights.data() + first, n);
    const std::vector<Index> ancestors = draw_survivors(both.weights, logs, mass.log_sum, options_, stream(draws, k));
    for (std::size_t d = 0; d < cloud.x.dimensions(); ++d)
      for (std::size_t j = 0; j < n; ++j) cloud.x.component(d)[first + j] = both.x.component(d)[ancestors[j]];
    return true;
  }

  /// Every group gets the weight n_k / N again, whatever its particles explained.
  static void reset(Cloud<R>& cloud, const Ring& ring) {
    for (std::size_t k = 0; k < ring.groups(); ++k) {
      const std::span<double> logs(cloud.log_weights.data() + ring.first(k), ring.size(k));
      const double mass = log_sum_exp(logs).log_sum;
      const double share = std::log(static_cast<double>(ring.size(k)) / static_cast<double>(cloud.size()));
      for (double& l : logs) l = std::isfinite(mass) ? l - mass + share : -std::log(static_cast<double>(cloud.size()));
    }
  }

  static Draws stream(Draws draws, std::size_t k) {
    draws.stream = static_cast<std::uint32_t>(k);
    return draws;
  }

  SelectionOptions options_;
  GroupOptions groups_;
};

}  // namespace mote

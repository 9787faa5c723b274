#pragma once
/// Select: the set that the next step starts from, for filters with importance weights.

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/filter/membership.hpp"
#include "mote/filter/options.hpp"
#include "mote/filter/particles.hpp"
#include "mote/filter/traffic.hpp"

namespace mote {

/// The weighted cloud of an importance filter: the particles of its groups that this process has. Carried log weights
/// of all groups have log-sum-exp 0 (in the mean, with w / a selection).
template <class R>
struct Cloud {
  Particles<R> x;
  std::vector<double> log_weights;  // (N,) normalised
  std::vector<double> weights;      // (N,) linear, scratch between update and select

  std::shared_ptr<const Membership> members;

  /// One group of n particles.
  Cloud(std::size_t dimensions, std::size_t n) : Cloud(dimensions, std::make_shared<Membership>(Groups(n, 1))) {}
  Cloud(std::size_t dimensions, std::shared_ptr<const Membership> all)
      : x(dimensions, all->particles()), log_weights(x.size()), weights(x.size()), members(std::move(all)) {
    spread();
  }
  /// Particles here, and in all groups.
  std::size_t size() const { return x.size(); }
  std::size_t all() const { return members->groups().particles(); }
  /// All particles weigh the same.
  void spread() {
    std::fill(log_weights.begin(), log_weights.end(), -std::log(static_cast<double>(all())));
    std::fill(weights.begin(), weights.end(), 1.0);
  }
};

/// Draws log_weights.size() ancestors and writes the log weights that they carry, `mass` in all (in the mean).
///
///   a_i ~ w_i^exponent;  survivor j carries  mass * (W_J / A_J) / n   (equal weights when exponent = 1)
///
/// choose(weights, ancestors) draws them, n a_i of particle i in the mean.
///
/// shape   weights: linear, overwritten; not all zero. log_weights: (n,)
/// source  IMH-OPT II-B
template <class Choose>
std::vector<Index> draw_survivors_by(std::span<double> weights, std::span<double> log_weights, double log_mass,
                                     double exponent, Choose&& choose) {
  const bool plain = exponent == 1;
  const auto sum = [&] { return ordered_sum(weights.size(), [&](std::size_t i) { return weights[i]; }); };
  const double total = sum();
  if (!plain)
    for (double& w : weights) w = w > 0 ? std::pow(w, exponent) : 0;
  std::vector<Index> ancestors(log_weights.size());
  choose(std::span<const double>(weights), std::span<Index>(ancestors));
  const double spread = log_mass - std::log(static_cast<double>(log_weights.size()));
  std::fill(log_weights.begin(), log_weights.end(), spread);
  if (plain) return ancestors;
  const double selection = sum();
  for (double& w : weights) w = std::pow(w, 1 / exponent - 1);  // w / a of the particle, up to the totals
  for (std::size_t j = 0; j < ancestors.size(); ++j)
    log_weights[j] = spread + std::log(weights[ancestors[j]] * selection / total);
  return ancestors;
}

/// The same by the options' scheme.
inline std::vector<Index> draw_survivors(std::span<double> weights, std::span<double> log_weights, double log_mass,
                                         const SelectionOptions& options, const Draws& draws) {
  return draw_survivors_by(
      weights, log_weights, log_mass, options.exponent,
      [&](std::span<const double> by, std::span<Index> ancestors) { options.scheme->resample(by, draws, ancestors); });
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

/// Replaces all particles by n draws among them, of equal weight (in the mean); they are one group.
template <class R>
void resample_to(Cloud<R>& cloud, std::size_t n, const SelectionOptions& options, const Draws& draws) {
  std::vector<double> carried(n);
  const std::vector<Index> ancestors = draw_survivors(cloud.weights, carried, 0.0, options, draws);
  cloud.x.resize(std::max(n, cloud.size()));
  cloud.x.gather(ancestors);
  cloud.x.resize(n);
  cloud.log_weights = std::move(carried);
  cloud.weights.resize(n);
  cloud.members = std::make_shared<Membership>(Groups(n, 1));
}

/// What a selection did.
struct Selected {
  bool any = false;  ///< anything was resampled
  Traffic traffic = {};
};

/// How an importance filter selects.
template <class R>
class Selector {
 public:
  virtual ~Selector() = default;
  /// Selects where the options ask for it.
  virtual Selected select(Cloud<R>& cloud, double ess, const Draws& draws) = 0;
  /// Has later selections leave so many particles.
  ///
  /// error   std::logic_error where groups select, whose sizes stay
  virtual void aim(std::size_t) { throw std::logic_error("groups of particles keep their sizes"); }
};

/// SISR: resamples the whole set when its effective sample size is low; docs/filters.md (F8).
template <class R>
class WholeSelector final : public Selector<R> {
 public:
  explicit WholeSelector(const SelectionOptions& options) : options_(options) {}

  Selected select(Cloud<R>& cloud, double ess, const Draws& draws) override {
    if (ess > options_.ess_threshold * static_cast<double>(cloud.size())) return {};
    if (children_ == 0 || children_ == cloud.size())
      resample(cloud, 0, cloud.size(), 0.0, options_, draws);
    else
      resample_to(cloud, children_, options_, draws);
    return {.any = true};
  }
  void aim(std::size_t children) override { children_ = children; }

 private:
  SelectionOptions options_;
  std::size_t children_ = 0;  // 0: as many as there are
};

}  // namespace mote

#include "mote/filter/adaptive.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "mote/base/draws.hpp"
#include "mote/base/normal.hpp"

namespace mote {
namespace {

constexpr double kMemory = 16;  // steps over which N / ESS is averaged

/// The bin of particle i in bins of these widths, as a hash of its coordinates.
template <class R>
std::uint64_t bin_of(const Particles<R>& x, std::size_t i, const std::vector<double>& widths) {
  std::uint64_t bin = 0;
  for (std::size_t d = 0; d < std::min(widths.size(), x.dimensions()); ++d)
    if (widths[d] > 0)
      bin = mixed(bin ^
                  std::bit_cast<std::uint64_t>(std::floor(static_cast<double>(x.component(d)[i]) / widths[d]) + 0.0));
  return bin;
}

}  // namespace

double particles_for_bins(std::size_t bins, double divergence, double surpassed) {
  if (bins < 2) return 1;
  const auto freedom = static_cast<double>(bins - 1);
  const double spread = 2 / (9 * freedom);
  const double root = 1 - spread + std::sqrt(spread) * standard_normal_quantile(1 - surpassed);
  return freedom / (2 * divergence) * root * root * root;
}

std::size_t occupied_bins(const WeightedSet& set, const std::vector<double>& widths) {
  std::unordered_map<std::uint64_t, double> bins;
  set.visit([&](const auto& x) {
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set.weights[i] > 0) bins[bin_of(x, i, widths)] += set.weights[i];
  });
  const double one = set.total / static_cast<double>(set.size());
  return static_cast<std::size_t>(
      std::count_if(bins.begin(), bins.end(), [&](const auto& bin) { return bin.second >= one; }));
}

void ParticleCounts::add(std::size_t particles, bool observed) {
  ++steps;
  sum += static_cast<double>(particles);
  if (!observed) return;
  least = least == 0 ? particles : std::min(least, particles);
  most = std::max(most, particles);
}

AdaptiveFilter::AdaptiveFilter(std::unique_ptr<Filter> filter, AdaptiveOptions options)
    : filter_(std::move(filter)), elastic_(dynamic_cast<Elastic*>(filter_.get())), options_(std::move(options)) {
  if (elastic_ == nullptr) throw std::invalid_argument("an adaptive number of particles wants SISR or chains");
}

StepReport AdaptiveFilter::predict(Step t) {
  const StepReport report = filter_->predict(t);
  counts_.add(elastic_->weighed(), false);
  return report;
}

StepReport AdaptiveFilter::update(Step t, Rows<double> rows) {
  const StepReport report = filter_->update(t, rows);
  note(report);
  return report;
}

void AdaptiveFilter::select(Step t, StepReport& report) {
  if (!options_.bins.empty() && !report.collapsed)
    for_bins_ =
        particles_for_bins(occupied_bins(filter_->weighted(), options_.bins), options_.divergence, options_.surpassed);
  elastic_->aim(wanted(report));
  filter_->select(t, report);
  if (std::isnan(report.acceptance)) return;
  acceptance_ = report.acceptance;
  elastic_->aim(wanted(report));  // of chains, whose next proposals are yet to come
}

void AdaptiveFilter::keep(Archive&) { throw std::logic_error("a run whose number of particles changes is not kept"); }

void AdaptiveFilter::note(const StepReport& report) {
  const std::size_t n = elastic_->weighed();
  counts_.add(n, true);
  if (report.collapsed) return;
  ratio_ = static_cast<double>(n) / report.ess;
  mean_ratio_ = mean_ratio_ == 0 ? ratio_ : mean_ratio_ + (ratio_ - mean_ratio_) / kMemory;
}

std::size_t AdaptiveFilter::wanted(const StepReport& report) const {
  if (report.collapsed || options_.error == 0) return options_.most;
  double ratio = std::max(ratio_, mean_ratio_);
  if (acceptance_ >= 0) ratio = std::max(ratio, 1 / worth_of_acceptance(std::max(acceptance_, 1e-9)));
  const double n = std::max(ratio / (options_.error * options_.error), for_bins_);
  if (!(n < static_cast<double>(options_.most))) return options_.most;
  const auto whole = (static_cast<std::size_t>(std::ceil(n)) + kWholeLanes - 1) / kWholeLanes * kWholeLanes;
  return std::clamp(whole, options_.least, options_.most);
}

}  // namespace mote

#include "mote/software/simd/block_sums.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"

namespace mote {

std::size_t ChildMap::block_of(std::uint32_t child) const {
  return static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), child) - first.begin()) - 1;
}

double Totals::log_sum() const { return std::log(weight) + reference * std::numbers::ln2; }

double Totals::ess() const {
  return square > 0 ? std::min(weight * weight / square, static_cast<double>(particles)) : 0;
}

double Totals::scale_of(double shift) const { return shift == reference ? 1 : std::exp2(shift - reference); }

BlockSums::BlockSums(std::size_t particles, std::size_t dimensions)
    : particles_(particles),
      dimensions_(dimensions),
      weights_((particles + kBlock - 1) / kBlock),
      components_(weights_.size() * dimensions) {}

Totals BlockSums::totals() const {
  Totals all{-kInfinity, 0, 0, particles_};
  for (const WeightSums& block : weights_) all.reference = std::max(all.reference, block.shift);
  if (!std::isfinite(all.reference)) return all;
  for (const WeightSums& block : weights_) {
    const double scale = all.scale_of(block.shift);
    all.weight += scale * block.weight;
    all.square += scale * scale * block.square;
  }
  return all;
}

Moments BlockSums::moments(const Totals& totals, std::size_t d) const {
  const auto sum = [&](auto&& term) {
    double all = 0;
    for (std::size_t b = 0; b < weights_.size(); ++b)
      if (weights_[b].weight > 0)
        all += totals.scale_of(weights_[b].shift) * term(weights_[b].weight, components_[b * dimensions_ + d]);
    return all / totals.weight;
  };
  const double mean = sum([](double w, const ComponentSums& c) { return c.first + c.centre * w; });
  const double variance = sum([&](double w, const ComponentSums& c) {
    const double offset = c.centre - mean;
    return c.second + offset * (2 * c.first + offset * w);
  });
  return {mean, std::sqrt(std::max(0.0, variance))};
}

void BlockSums::map_children(const Totals& totals, double u, ChildMap& map) const {
  const std::size_t blocks = weights_.size();
  map.position.resize(blocks + 1);
  map.children_per_weight.resize(blocks);
  map.first.resize(blocks + 1);
  const auto n = static_cast<double>(particles_);
  const double per_weight = n / totals.weight;
  double before = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const double scale = totals.scale_of(weights_[b].shift);
    map.position[b] = before * per_weight - u;
    map.children_per_weight[b] = per_weight * scale;
    map.first[b] = static_cast<std::uint32_t>(std::clamp(std::ceil(map.position[b]), 0.0, n));
    before += scale * weights_[b].weight;
  }
  map.position[blocks] = before * per_weight - u;
  // the last children are the last block's that has weight, however the sums were rounded
  const auto all = static_cast<std::uint32_t>(particles_);
  map.first[blocks] = all;
  for (std::size_t b = blocks; b-- > 0 && !(weights_[b].weight > 0);) map.first[b] = all;
}

}  // namespace mote

#include "mote/software/simd/block_sums.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"
#include "mote/software/share.hpp"

namespace mote {
namespace {

constexpr double kTooLarge = 1023;  // exponents from here on count as infinity
constexpr double kLeastExponent = -1022;

/// 2^k for a whole k of at most 1023; 0 where that is no normal number.
double power_of_two(double k) {
  if (!(k >= -1022)) return 0;
  return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<int>(k) + 1023) << 52U);
}

/// A k with |value| < 2^k.
double exponent_above(double value) {
  return static_cast<double>(static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52U & 0x7FFU) - 1022);
}

}  // namespace

std::size_t ChildMap::block_of(std::uint32_t child) const {
  return static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), child) - first.begin()) - 1;
}

double Totals::log_sum() const { return std::log(weight) + reference * std::numbers::ln2; }

double Totals::ess() const {
  return square > 0 ? std::min(weight * weight / square, static_cast<double>(particles)) : 0;
}

double Totals::scale_of(double shift) const { return power_of_two(shift - reference); }

BlockSums::BlockSums(std::size_t particles, std::size_t dimensions, Team* team, std::size_t all)
    : particles_(particles),
      dimensions_(dimensions),
      team_(team),
      all_(team == nullptr ? particles : all),
      weights_(blocks_of(particles)),
      components_(weights_.size() * dimensions) {
  if (!tells(particles_, all_)) return;
  for (std::size_t r = 0; r <= team->ranks(); ++r) begins_.push_back(Cut(blocks_of(all_), team->ranks()).begin(r));
  everyones_.emplace_back(all_, dimensions);
}

/// Completes everyones_ by the sums of all ranks.
void BlockSums::tell() const {
  BlockSums& all = everyones_.front();
  const std::size_t triples = 1 + dimensions_;  // of a block
  told_.resize(all.blocks() * triples);
  Triple* told = told_.data() + begins_[team_->rank()] * triples;
  for (std::size_t b = 0; b < blocks(); ++b) {
    *told++ = std::bit_cast<Triple>(weights_[b]);
    for (std::size_t d = 0; d < dimensions_; ++d) *told++ = std::bit_cast<Triple>(components_[b * dimensions_ + d]);
  }
  std::vector<std::size_t> begins = begins_;  // of numbers
  for (std::size_t& begin : begins) begin *= triples * std::tuple_size_v<Triple>;
  team_->complete(std::as_writable_bytes(std::span(told_)), begins);
  told = told_.data();
  for (std::size_t b = 0; b < all.blocks(); ++b) {
    all.weights_[b] = std::bit_cast<WeightSums>(*told++);
    for (std::size_t d = 0; d < dimensions_; ++d)
      all.components_[b * dimensions_ + d] = std::bit_cast<ComponentSums>(*told++);
  }
}

Totals BlockSums::totals() const {
  if (!everyones_.empty()) {
    tell();
    return everyones_.front().totals();
  }
  Totals totals{-kInfinity, 0, 0, all_, {}, {}};
  for (const WeightSums& block : weights_) totals.reference = std::max(totals.reference, block.shift);
  if (team_ != nullptr) team_->largest({&totals.reference, 1});
  if (!std::isfinite(totals.reference)) return totals;
  if (alone_in_one_block()) {
    totals.weight = weights_[0].weight;
    totals.square = weights_[0].square;
    return totals;
  }
  std::array<ExactSum, 2> sums;  // of weights and of their squares
  for (const WeightSums& block : weights_) {
    const double scale = totals.scale_of(block.shift);
    sums[0].add(scale * block.weight);
    sums[1].add(scale * scale * block.square);
  }
  totals.mine = sums[0];
  add_up_with_team(sums);
  totals.all = sums[0];
  totals.weight = sums[0].value();
  totals.square = sums[1].value();
  return totals;
}

/// aligned_[d] = sum over the blocks of term(b, d), in the scale of the totals. The largest of the terms says where the
/// fixed point is, so that none is too large or too small for it; infinity where one is not finite. A single block's
/// terms are the sums.
template <class Term>
void BlockSums::add_aligned(const Totals& totals, const Term& term) const {
  const auto each = [&](const auto& take) {
    for (std::size_t b = 0; b < weights_.size(); ++b) {
      if (!(weights_[b].weight > 0)) continue;
      const double scale = totals.scale_of(weights_[b].shift);
      for (std::size_t d = 0; d < dimensions_; ++d)
        take(d, scale * term(d, weights_[b].weight, components_[b * dimensions_ + d]));
    }
  };
  aligned_.assign(dimensions_, 0.0);
  if (alone_in_one_block()) return each([&](std::size_t d, double value) { aligned_[d] = value; });
  exponents_.assign(dimensions_, kLeastExponent);
  each([&](std::size_t d, double value) { exponents_[d] = std::max(exponents_[d], exponent_above(value)); });
  if (team_ != nullptr) team_->largest(exponents_);
  exact_.assign(dimensions_, {});
  for (std::size_t d = 0; d < dimensions_; ++d) aligned_[d] = power_of_two(-exponents_[d]);
  each([&](std::size_t d, double value) {
    if (exponents_[d] < kTooLarge) exact_[d].add(value * aligned_[d]);
  });
  add_up_with_team(exact_);
  for (std::size_t d = 0; d < dimensions_; ++d)
    aligned_[d] = exponents_[d] < kTooLarge ? exact_[d].value() * power_of_two(exponents_[d]) : kInfinity;
}

void BlockSums::complete_shifts() {
  std::vector<double> shifts;
  for (const WeightSums& block : weights_) shifts.push_back(block.shift);
  team_->largest(shifts);
  for (std::size_t b = 0; b < shifts.size(); ++b) weights_[b].shift = shifts[b];
}

void BlockSums::moments(const Totals& totals, bool spreads, std::span<Moments> all) const {
  if (!everyones_.empty()) return everyones_.front().moments(totals, spreads, all);
  add_aligned(totals, [](std::size_t, double w, const ComponentSums& c) { return c.first + c.centre * w; });
  for (std::size_t d = 0; d < dimensions_; ++d) all[d] = {aligned_[d] / totals.weight, kNaN};
  if (!spreads) return;
  const auto about_the_mean = [&](std::size_t d, double w, const ComponentSums& c) {
    const double offset = c.centre - all[d].mean;
    return c.second + offset * (2 * c.first + offset * w);
  };
  add_aligned(totals, about_the_mean);
  for (std::size_t d = 0; d < dimensions_; ++d) all[d].sd = std::sqrt(std::max(0.0, aligned_[d] / totals.weight));
}

/// The part of this rank from the map of all blocks.
void BlockSums::take_part(const ChildMap& all, ChildMap& map) const {
  const auto part = [&](const auto& from, auto& to, std::size_t count) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(begins_[team_->rank()]);
    to.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  part(all.position, map.position, blocks() + 1);
  part(all.first, map.first, blocks() + 1);
  part(all.children_per_weight, map.children_per_weight, blocks());
  map.born.clear();
  for (const std::size_t begin : begins_) map.born.push_back(all.first[begin]);
}

void BlockSums::map_children(const Totals& totals, double u, std::size_t children, ChildMap& map) const {
  if (!everyones_.empty()) {
    everyones_.front().map_children(totals, u, children, map_of_all_);
    return take_part(map_of_all_, map);
  }
  const std::size_t blocks = weights_.size();
  map.position.resize(blocks + 1);
  map.children_per_weight.resize(blocks);
  map.first.resize(blocks + 1);
  const auto n = static_cast<double>(children);
  const double per_weight = n / totals.weight;
  if (alone_in_one_block()) {
    map.position = {-u, n - u};
    map.children_per_weight[0] = per_weight;
    map.first[0] = 0;
    map.first[1] = static_cast<std::uint32_t>(children);
    map.born = map.first;
    return;
  }
  ExactSum before = team_ == nullptr ? ExactSum{} : team_->before(totals.mine);
  for (std::size_t b = 0; b <= blocks; ++b) {
    const double position = before.value() * per_weight - u;
    // what lies behind all weight begins behind the last child, however the product was rounded
    map.first[b] = static_cast<std::uint32_t>(before == totals.all ? n : std::clamp(std::ceil(position), 0.0, n));
    map.position[b] = position;
    if (b == blocks) break;
    const double scale = totals.scale_of(weights_[b].shift);
    map.children_per_weight[b] = per_weight * scale;
    before.add(scale * weights_[b].weight);
  }
  if (team_ == nullptr) return;
  map.born = team_->gather(map.first.front());
  map.born.push_back(static_cast<std::uint32_t>(children));
}

}  // namespace mote

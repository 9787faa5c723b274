#include "mote/hardware/filters/groups.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mote::hardware {
namespace {

/// Stages that find the groups' largest scale and bring their weights to it.
std::uint64_t common_scale_cycles(std::size_t groups) { return row_cycles(groups) + 1; }

}  // namespace

Groups::Groups(Arithmetic arithmetic, std::uint64_t seed, unsigned stream, unsigned groups, Resampler resampler)
    : arithmetic_(std::move(arithmetic)) {
  for (unsigned l = 0; l < groups; ++l) groups_.push_back({ResamplerWords(resampler, Words(seed, stream + l))});
  for (unsigned w = 0; w < groups * arithmetic_.formats.draw_words; ++w)
    draw_words_.emplace_back(seed, stream + groups + w);
}

void Groups::start(std::uint32_t particles, std::uint32_t exchange) {
  const Formats& f = arithmetic_.formats;
  t_ = 0;
  exchange_ = exchange;
  pace_ = Pace{};
  set_.assign(f.dims, std::vector<std::int64_t>(particles));
  parents_ = set_;
  words_.assign(f.draw_words, std::vector<std::uint32_t>(particles));
  log_weights_.assign(particles, 0);
  weights_.assign(particles, {});
  issued_.assign(particles / groups_.size(), 0);
  written_ = issued_;
  for (Group& group : groups_) group.weights.assign(issued_.size(), {});
}

Estimate Groups::step(Observed observed) {
  ++t_;
  pace_.begin();
  if (t_ > 1) choose_parents();
  draw_words();
  arithmetic_.propose(t_, observed, parents_, words_, set_);
  arithmetic_.weigh(t_, observed, set_, log_weights_);
  keep_time();
  weigh_groups();
  return infer();
}

/// The groups' walks side by side: a child of each when all have a parent for it.
void Groups::choose_parents() {
  std::vector<std::unique_ptr<ParentWalk>> walks;
  for (Group& group : groups_)
    walks.push_back(group.resampler.walk({group.weights, group.total, written_}, arithmetic_.formats, 1));
  std::vector<std::uint32_t> parents;
  const std::size_t n = issued_.size();
  std::size_t behind = n / 2;
  for (std::size_t child = 0; child < n;) {
    const std::uint64_t now = walks.front()->now();
    const bool taken = now > pace_.begun() + 1 &&
                       std::all_of(walks.begin(), walks.end(), [](const auto& walk) { return walk->shows(); });
    parents.clear();
    for (const auto& walk : walks) walk->cycle(taken, parents);
    if (!taken) continue;
    behind += exchange_;
    take_parents(child, behind >= n, parents);
    if (behind >= n) behind -= n;
    issued_[child++] = now;
  }
}

/// A child in each group, of its own parent or of the one before it in the ring.
void Groups::take_parents(std::size_t child, bool exchanged, std::span<const std::uint32_t> parents) {
  const std::size_t count = groups_.size();
  for (std::size_t l = 0; l < count; ++l) {
    const std::size_t from = exchanged ? (l + count - 1) % count : l;
    for (std::size_t d = 0; d < set_.size(); ++d)
      parents_[d][child * count + l] = set_[d][parents[from] * count + from];
  }
}

void Groups::draw_words() {
  const std::size_t columns = words_.size();
  for (std::size_t w = 0; w < columns; ++w)
    for (std::size_t j = 0; j < words_[w].size(); ++j)
      words_[w][j] = draw_words_[j % groups_.size() * columns + w].next();
}

void Groups::weigh_groups() {
  std::vector<std::int64_t> log_weights(issued_.size());
  for (std::size_t l = 0; l < groups_.size(); ++l) {
    for (std::size_t k = 0; k < log_weights.size(); ++k) log_weights[k] = log_weights_[k * groups_.size() + l];
    scale_weights(log_weights, 1, arithmetic_.formats.weight_bits, groups_[l].weights);
    groups_[l].total = sum_of(groups_[l].weights);
    groups_[l].resampler.end_step();
  }
}

Estimate Groups::infer() {
  const Formats& f = arithmetic_.formats;
  scale_weights(log_weights_, groups_.size(), f.weight_bits, weights_);
  const std::uint64_t total = sum_of(weights_);
  return {weighted_means(set_, weights_, total, f), total, weights_.back().scale, 0};
}

void Groups::keep_time() {
  const Formats& f = arithmetic_.formats;
  if (t_ == 1) std::iota(issued_.begin(), issued_.end(), pace_.begun() + 2);
  const std::uint64_t model = 2 + f.propose_latency + f.weigh_latency;
  for (std::size_t k = 0; k < issued_.size(); ++k) written_[k] = issued_[k] + model + weight_cycles(1);
  pace_.free_from(issued_.back() + model);
  pace_.sums_stand(written_.back() + sum_cycles(f, groups_.size()) + common_scale_cycles(groups_.size()),
                   division_cycles(f));
}

}  // namespace mote::hardware

#include "mote/hardware/filters/imh.hpp"

#include <bit>
#include <span>
#include <utility>

namespace mote::hardware {

Imh::Imh(Arithmetic arithmetic, std::uint64_t seed, unsigned stream, ImhLanes lanes)
    : arithmetic_(std::move(arithmetic)), lanes_(lanes) {
  for (unsigned lane = 0; lane < lanes.count; ++lane) {
    parent_words_.emplace_back(seed, stream++);
    accept_words_.emplace_back(seed, stream++);
    for (unsigned w = 0; w < arithmetic_.formats.draw_words; ++w) draw_words_.emplace_back(seed, stream++);
  }
}

void Imh::start(const ImhRegisters& registers) {
  registers_ = registers;
  t_ = 0;
  pace_ = Pace{};
  const std::size_t n = std::size_t{lanes_.rows(registers)} * lanes_.count;
  const Formats& f = arithmetic_.formats;
  set_.assign(f.dims, std::vector<std::int64_t>(registers.particles));
  parents_.assign(f.dims, std::vector<std::int64_t>(n));
  proposals_.assign(f.dims + f.carried, std::vector<std::int64_t>(n));
  words_.assign(f.draw_words, std::vector<std::uint32_t>(n));
  log_weights_.assign(n, 0);
  weights_.assign(n, {});
  kept_.assign(registers.particles, 0);
}

Estimate Imh::step(Observed observed) {
  ++t_;
  choose_parents();
  propose(observed);
  std::uint64_t accepted = 0;
  for (unsigned chain = 0; chain < lanes_.chains(); ++chain) accepted += decide(chain);
  for (std::size_t d = 0; d < set_.size(); ++d)
    for (std::size_t k = 0; k < kept_.size(); ++k) set_[d][k] = proposals_[d][kept_[k]];
  keep_time();
  Estimate estimate = infer();
  estimate.accepted = accepted;
  return estimate;
}

/// Slots that the parents of a row are chosen among.
std::uint32_t Imh::slots_of_row(std::size_t row) const {
  const std::uint32_t all = registers_.particles / lanes_.count;
  if (!lanes_.overlapped) return all;
  const std::uint64_t later = ImhLatency(arithmetic_.formats, lanes_).restricted(all);
  return all - static_cast<std::uint32_t>(later - std::min<std::uint64_t>(later, row));
}

void Imh::choose_parents() {
  const unsigned lanes = lanes_.count;
  const int low = 8 - std::countr_zero(lanes);
  for (std::size_t row = 0; row < log_weights_.size(); row += lanes) {
    const std::uint32_t turn = parent_words_[0].word() >> low;
    const std::uint32_t slots = slots_of_row(row / lanes);
    for (unsigned lane = 0; lane < lanes; ++lane) {
      const std::uint32_t word = parent_words_[lane].next();
      const std::uint32_t chain = lanes_.parents == Parents::kPrivate  ? lane
                                  : lanes_.parents == Parents::kBanked ? lane + turn
                                                                       : word >> low;
      const std::size_t i = ((std::uint64_t{word >> 8} * slots) >> 24) * lanes + chain % lanes;
      for (std::size_t d = 0; d < set_.size(); ++d) parents_[d][row + lane] = set_[d][i];
    }
  }
}

void Imh::propose(Observed observed) {
  const std::size_t columns = words_.size();
  for (std::size_t w = 0; w < columns; ++w)
    for (std::size_t j = 0; j < words_[w].size(); ++j)
      words_[w][j] = draw_words_[j % lanes_.count * columns + w].next();
  arithmetic_.propose(t_, observed, parents_, words_, proposals_);
  arithmetic_.weigh(t_, observed, proposals_, log_weights_);
}

/// Runs a chain; says how often it moved.
std::uint64_t Imh::decide(unsigned chain) {
  const std::size_t dropped = log_weights_.size() - kept_.size();
  std::uint32_t current = chain;
  std::uint64_t accepted = 0;
  for (std::uint32_t j = chain; j < log_weights_.size(); j += lanes_.chains()) {
    const std::int64_t drop = log_drop(accept_words_[j % lanes_.count].next());
    if (j > chain && log_weights_[current] <= log_weights_[j] + drop) {
      current = j;
      ++accepted;
    }
    if (j >= dropped) kept_[j - dropped] = current;
  }
  return accepted;
}

Estimate Imh::infer() {
  const Formats& f = arithmetic_.formats;
  scale_weights(log_weights_, lanes_.count, f.weight_bits, weights_);
  const std::uint64_t sum = sum_of(weights_);
  const std::span<const std::vector<std::int64_t>> states = std::span(proposals_).first(f.dims);
  const std::int64_t scale = weights_.back().scale;
  if (!registers_.chain_mean) return {weighted_means(states, weights_, sum, f), sum, scale, 0};
  const std::vector<ScaledWeight> equal(kept_.size(), {1 << 16, 0, 0});
  return {weighted_means(set_, equal, sum_of(equal), f), sum, scale, 0};
}

void Imh::keep_time() {
  const ImhLatency latency(arithmetic_.formats, lanes_);
  pace_.begin();
  pace_.free_from(pace_.begun() + latency.step(registers_, lanes_));
  // All is in when the last weight is, and the last state that was kept.
  const std::uint64_t log_weight = pace_.begun() + latency.decided(registers_, lanes_) - lanes_.chain_latency();
  const std::uint64_t done =
      log_weight + std::max<std::uint64_t>(weight_cycles(lanes_.count), lanes_.chain_latency() + 1);
  pace_.sums_stand(done + sum_cycles(arithmetic_.formats, lanes_.count), division_cycles(arithmetic_.formats));
}

}  // namespace mote::hardware

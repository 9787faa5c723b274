#include "mote/hardware/filters/imh.hpp"

#include <utility>

namespace mote::hardware {

Imh::Imh(Arithmetic arithmetic, std::uint64_t seed, unsigned stream)
    : arithmetic_(std::move(arithmetic)), parent_words_(seed, stream), accept_words_(seed, stream + 1) {
  for (unsigned w = 0; w < arithmetic_.formats.draw_words; ++w) draw_words_.emplace_back(seed, stream + 2 + w);
}

void Imh::start(const ImhRegisters& registers) {
  registers_ = registers;
  t_ = 0;
  pace_ = Pace{};
  const std::size_t n = registers.proposals();
  const Formats& f = arithmetic_.formats;
  set_.assign(f.dims, std::vector<std::int64_t>(registers.particles));
  parents_.assign(f.dims, std::vector<std::int64_t>(n));
  proposals_ = parents_;
  words_.assign(f.draw_words, std::vector<std::uint32_t>(n));
  log_weights_.assign(n, 0);
  kept_.assign(registers.particles, 0);
}

Estimate Imh::step(Observed observed) {
  ++t_;
  draw(observed);
  const std::uint64_t accepted = decide();
  for (std::size_t d = 0; d < set_.size(); ++d)
    for (std::size_t k = 0; k < kept_.size(); ++k) set_[d][k] = proposals_[d][kept_[k]];
  keep_time();
  Estimate estimate = infer();
  estimate.accepted = accepted;
  return estimate;
}

void Imh::draw(Observed observed) {
  for (std::size_t j = 0; j < log_weights_.size(); ++j) {
    const std::size_t i = (std::uint64_t{parent_words_.next() >> 8} * registers_.particles) >> 24;
    for (std::size_t d = 0; d < set_.size(); ++d) parents_[d][j] = set_[d][i];
  }
  for (std::size_t w = 0; w < words_.size(); ++w) draw_words_[w].fill(words_[w]);
  arithmetic_.propose(t_, observed, parents_, words_, proposals_);
  arithmetic_.weigh(t_, observed, proposals_, log_weights_);
}

/// Runs the chain; says how often it moved.
std::uint64_t Imh::decide() {
  const std::size_t dropped = log_weights_.size() - kept_.size();
  std::uint32_t current = 0;
  std::uint64_t accepted = 0;
  for (std::uint32_t j = 0; j < log_weights_.size(); ++j) {
    const std::int64_t drop = log_drop(accept_words_.next());
    if (j > 0 && log_weights_[current] <= log_weights_[j] + drop) {
      current = j;
      ++accepted;
    }
    if (j >= dropped) kept_[j - dropped] = current;
  }
  return accepted;
}

Estimate Imh::infer() const {
  const Formats& f = arithmetic_.formats;
  RunningScale scale(f.weight_bits);
  WeightSum sum;
  ValueSums values(f.dims);
  for (std::size_t j = 0; j < log_weights_.size(); ++j) {
    const ScaledWeight w = j == 0 ? scale.first(log_weights_[j]) : scale.next(log_weights_[j]);
    j == 0 ? sum.first(w) : sum.next(w);
    if (!registers_.chain_mean)
      j == 0 ? values.first(proposals_, j, w.weight) : values.next(proposals_, j, w.weight, w.rise);
  }
  std::uint64_t divisor = sum.sum();
  if (registers_.chain_mean) {
    constexpr std::uint64_t kOne = 1 << 16;
    values.first(set_, 0, kOne);
    for (std::size_t k = 1; k < kept_.size(); ++k) values.next(set_, k, kOne, 0);
    divisor = kept_.size() * kOne;
  }
  return {values.divided(divisor, f.extra_bits), sum.sum(), sum.scale(), 0};
}

void Imh::keep_time() {
  pace_.begin();
  const std::uint64_t decided = pace_.begun() + ImhLatency(arithmetic_.formats).step(registers_);
  pace_.free_from(decided);
  pace_.sums_stand(decided + 8, division_cycles(arithmetic_.formats));
}

}  // namespace mote::hardware

#include "mote/hardware/filters/sisr.hpp"

#include <numeric>
#include <utility>

namespace mote::hardware {

Sisr::Sisr(Arithmetic arithmetic, std::uint64_t seed, unsigned stream)
    : arithmetic_(std::move(arithmetic)), resample_words_(seed, stream) {
  for (unsigned w = 0; w < arithmetic_.formats.draw_words; ++w) draw_words_.emplace_back(seed, stream + 1 + w);
}

void Sisr::start(std::uint32_t particles) {
  const Formats& f = arithmetic_.formats;
  t_ = 0;
  pace_ = Pace{};
  set_.assign(f.dims, std::vector<std::int64_t>(particles));
  parents_ = set_;
  words_.assign(f.draw_words, std::vector<std::uint32_t>(particles));
  log_weights_.assign(particles, 0);
  weights_.assign(particles, {});
  issued_.assign(particles, 0);
  written_.assign(particles, 0);
}

Estimate Sisr::step(Observed observed) {
  ++t_;
  pace_.begin();
  choose_parents();
  for (std::size_t w = 0; w < words_.size(); ++w) draw_words_[w].fill(words_[w]);
  arithmetic_.propose(t_, observed, parents_, words_, set_);
  arithmetic_.weigh(t_, observed, set_, log_weights_);
  keep_time();
  return infer();
}

/// Walks the weights of the step before, as its parents are taken one a cycle.
void Sisr::choose_parents() {
  if (t_ == 1) {
    std::iota(issued_.begin(), issued_.end(), pace_.begun() + 1);
    return;
  }
  const std::vector<std::uint64_t> sums = cumulative_sums(weights_);
  SystematicWalk walk(sums, total_, uniform_, written_, written_.back() - 3);
  for (std::size_t j = 0; j < issued_.size();) {
    std::uint32_t parent = 0;
    const std::uint64_t now = walk.now();
    if (!walk.cycle(now > pace_.begun(), parent)) continue;
    for (std::size_t d = 0; d < set_.size(); ++d) parents_[d][j] = set_[d][parent];
    issued_[j++] = now;
  }
}

Estimate Sisr::infer() {
  const Formats& f = arithmetic_.formats;
  RunningScale scale(f.weight_bits);
  WeightSum sum;
  ValueSums values(f.dims);
  for (std::size_t j = 0; j < weights_.size(); ++j) {
    const ScaledWeight w = weights_[j] = j == 0 ? scale.first(log_weights_[j]) : scale.next(log_weights_[j]);
    j == 0 ? sum.first(w) : sum.next(w);
    j == 0 ? values.first(set_, j, w.weight) : values.next(set_, j, w.weight, w.rise);
  }
  total_ = sum.sum();
  uniform_ = resample_words_.next() >> 8;
  return {values.divided(total_, f.extra_bits), total_, sum.scale(), 0};
}

void Sisr::keep_time() {
  const Formats& f = arithmetic_.formats;
  const std::uint64_t model = 3 + f.propose_latency + f.weigh_latency;
  for (std::size_t j = 0; j < issued_.size(); ++j) written_[j] = issued_[j] + model + 5;
  pace_.free_from(issued_.back() + model);
  pace_.sums_stand(written_.back() + 4, division_cycles(f));
}

}  // namespace mote::hardware

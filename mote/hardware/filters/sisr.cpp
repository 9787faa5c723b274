#include "mote/hardware/filters/sisr.hpp"

#include <utility>

namespace mote::hardware {
namespace {

constexpr std::uint64_t kOtherTurn = 6;  ///< cycles of a turn of the loops that normalise and resample

}  // namespace

Sisr::Sisr(Arithmetic arithmetic, std::uint64_t seed, unsigned stream, unsigned lanes, Resampler resampler)
    : arithmetic_(std::move(arithmetic)), lanes_(lanes), resampler_(resampler, Words(seed, stream)) {
  for (unsigned w = 0; w < lanes * arithmetic_.formats.draw_words; ++w) draw_words_.emplace_back(seed, stream + 1 + w);
}

Sisr::Sisr(Arithmetic arithmetic, std::uint64_t seed, unsigned stream, PlainLoops loops, Resampler resampler)
    : Sisr(std::move(arithmetic), seed, stream, 1, resampler) {
  loops_ = loops;
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
  issued_.assign(particles / lanes_, 0);
  written_ = issued_;
}

Estimate Sisr::step(Observed observed) {
  ++t_;
  if (!loops_) pace_.begin();
  if (t_ > 1) choose_parents();
  if (loops_) pace_.begin();
  const std::size_t columns = words_.size();
  for (std::size_t w = 0; w < columns; ++w)
    for (std::size_t j = 0; j < words_[w].size(); ++j) words_[w][j] = draw_words_[j % lanes_ * columns + w].next();
  arithmetic_.propose(t_, observed, parents_, words_, set_);
  arithmetic_.weigh(t_, observed, set_, log_weights_);
  loops_ ? keep_loops_time() : keep_time();
  return infer();
}

void Sisr::choose_parents() {
  const auto walk = resampler_.walk({weights_, total_, written_}, arithmetic_.formats, lanes_);
  const std::vector<std::uint32_t> parents = loops_ ? walk_last(*walk) : walk_beside(*walk);
  for (std::size_t d = 0; d < set_.size(); ++d)
    for (std::size_t j = 0; j < parents.size(); ++j) parents_[d][j] = set_[d][parents[j]];
}

/// Whether the step takes a parent in a cycle: from its beginning on, one in `interval` cycles.
bool Sisr::in_turn(std::uint64_t cycle) const {
  const std::uint64_t first = pace_.begun() + 2;
  return cycle >= first && (cycle - first) % arithmetic_.formats.interval == 0;
}

/// The walk beside the next step's proposals: parents are taken as they come, once the step has begun.
std::vector<std::uint32_t> Sisr::walk_beside(ParentWalk& walk) {
  std::vector<std::uint32_t> parents;
  for (std::size_t k = 0; k < issued_.size();) {
    const std::uint64_t now = walk.now();
    if (walk.cycle(in_turn(now), parents)) issued_[k++] = now;
  }
  return parents;
}

/// The walk as the last loop of the step before; the next step begins when it is through.
std::vector<std::uint32_t> Sisr::walk_last(ParentWalk& walk) {
  std::vector<std::uint32_t> parents;
  for (std::uint64_t turn = written_.back() + 1; parents.size() < written_.size();) {
    const std::uint64_t now = walk.now();
    if (!walk.cycle(now >= turn, parents)) continue;
    turn = now + (loops_->pipelined ? 1 : kOtherTurn);
    pace_.free_from(now + 1);
  }
  return parents;
}

Estimate Sisr::infer() {
  const Formats& f = arithmetic_.formats;
  scale_weights(log_weights_, lanes_, f.weight_bits, weights_);
  total_ = sum_of(weights_);
  resampler_.end_step();
  return {weighted_means(set_, weights_, total_, f), total_, weights_.back().scale, 0};
}

void Sisr::keep_time() {
  const Formats& f = arithmetic_.formats;
  if (t_ == 1)
    for (std::size_t k = 0; k < issued_.size(); ++k) issued_[k] = pace_.begun() + 2 + k * f.interval;
  const std::uint64_t model = 2 + f.propose_latency + f.weigh_latency;
  for (std::size_t k = 0; k < issued_.size(); ++k) written_[k] = issued_[k] + model + weight_cycles(lanes_);
  pace_.free_from(issued_.back() + model);
  pace_.sums_stand(written_.back() + sum_cycles(f, lanes_), division_cycles(f));
}

/// A loop's turns take `turn` cycles, or one each and the rest at the end.
void Sisr::keep_loops_time() {
  const Formats& f = arithmetic_.formats;
  const std::uint64_t n = written_.size();
  const auto every = [&](std::uint64_t turn) { return loops_->pipelined ? 1 : turn; };
  std::uint64_t begins = pace_.begun() + 1;
  const auto pass = [&](std::uint64_t turn) { begins += (n - 1) * every(turn) + turn; };
  std::uint64_t last = kOtherTurn;
  if (loops_->merged) {
    last = f.propose_latency + f.weigh_latency + 8;
  } else {
    pass(f.propose_latency + 5);
    pass(f.weigh_latency + 3);
  }
  for (std::uint64_t k = 0; k < n; ++k) written_[k] = begins + k * every(last) + last - 1;
  pace_.sums_stand(written_.back() + sum_cycles(f, 1), division_cycles(f));
}

}  // namespace mote::hardware

#include "mote/hardware/filters/offspring.hpp"

#include <algorithm>
#include <bit>

namespace mote::hardware {

std::uint32_t reciprocal_of(std::uint32_t x) {
  const std::uint32_t middle = 129 + 2 * ((x >> 11) & 63);  // of a segment of 64, in units of 2^10
  const std::uint32_t square = middle * middle;
  const auto base = static_cast<std::uint32_t>((std::uint64_t{middle + 1} << 25) / square);
  const std::uint32_t slope = ((1U << 26) + square - 1) / square;
  return ((base << 11) - slope * (x & 2047)) >> 11;
}

std::vector<std::uint32_t> Offspring::ends(std::span<const ScaledWeight> weights, std::uint64_t total,
                                           std::uint32_t uniform) const {
  const unsigned sum_bits = weight_bits + count_bits;
  const unsigned zeros = sum_bits - static_cast<unsigned>(std::bit_width(total));
  const unsigned drop = count_bits - 6;
  const unsigned fraction = 34 - drop;
  const std::uint64_t reciprocal = reciprocal_of(static_cast<std::uint32_t>((total << zeros) >> (sum_bits - 18)));
  const std::uint64_t factor = (reciprocal * weights.size()) >> drop;
  std::vector<std::uint32_t> ends;
  ends.reserve(weights.size());
  std::uint64_t sum = 0;
  for (const ScaledWeight& w : weights) {
    const std::uint64_t weight = lowered(w.weight, quanta_between(w.scale, weights.back().scale));
    sum += (weight << zeros) >> count_bits;
    const std::uint64_t share = sum >> (weight_bits - 17);
    const std::uint64_t place = share * factor + (std::uint64_t{uniform} << (fraction - 24));
    ends.push_back(static_cast<std::uint32_t>(place >> fraction));
  }
  ends.back() = static_cast<std::uint32_t>(weights.size());
  return ends;
}

std::vector<std::uint32_t> parents_of(std::span<const std::uint32_t> ends) {
  std::vector<std::uint32_t> parents;
  parents.reserve(ends.size());
  for (std::uint32_t i = 0; i < ends.size(); ++i) parents.resize(std::max<std::size_t>(parents.size(), ends[i]), i);
  return parents;
}

ChildrenWalk::ChildrenWalk(std::span<const std::uint32_t> ends, unsigned lanes, std::uint64_t last_write,
                           unsigned product_latency)
    : ends_(ends),
      lanes_(lanes),
      rows_((ends.size() + 2 * lanes - 1) / (2 * lanes)),
      latency_(8 + product_latency + static_cast<std::size_t>(std::countr_zero(lanes))),
      now_(last_write + 1 + static_cast<std::size_t>(std::countr_zero(lanes)) + factor_wait(product_latency)) {}

/// The children up to a row's last particle.
std::uint32_t ChildrenWalk::end_of(std::size_t row) const {
  return ends_[std::min(ends_.size(), 2 * lanes_ * (row + 1)) - 1];
}

/// Takes from the rows of the window what the group wants; says whether that completes it.
bool ChildrenWalk::looks() {
  const auto group_end = static_cast<std::uint32_t>(first_ + lanes_);
  const bool done = end_of(window_.back()) >= group_end;
  if (done) first_ = group_end;
  while (!window_.empty() && (!done || end_of(window_.front()) <= group_end)) window_.pop_front();
  return done;
}

bool ChildrenWalk::cycle(bool ready) {
  const bool taken = shows_ && ready;
  if (!shows_ || ready) {
    const bool found = !window_.empty() && looks();
    shows_ = lanes_ == 1 ? found : looked_;
    looked_ = found;
  }

  std::size_t freed = 0;
  if (!queue_.empty() && window_.size() < (lanes_ == 1 ? 1 : 2)) {
    window_.push_back(queue_.front());
    queue_.pop_front();
    ++freed;
  }
  if (!flying_.empty() && flying_.front().cycle == now_) {
    const std::size_t row = flying_.front().row;
    flying_.pop_front();
    if (end_of(row) == (row == 0 ? 0 : end_of(row - 1)))
      ++freed;
    else
      queue_.push_back(row);
  }
  if (read_ < rows_ && room_ > 0) {
    flying_.push_back({now_ + latency_, read_++});
    --room_;
  }
  room_ += freed_;
  freed_ = freed;
  ++now_;
  return taken;
}

}  // namespace mote::hardware

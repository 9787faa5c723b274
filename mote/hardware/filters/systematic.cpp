#include "mote/hardware/filters/systematic.hpp"

#include <algorithm>

namespace mote::hardware {

std::vector<std::uint64_t> cumulative_sums(std::span<const ScaledWeight> weights) {
  std::vector<std::uint64_t> sums;
  sums.reserve(weights.size());
  std::uint64_t sum = 0;
  for (const ScaledWeight& w : weights) {
    const std::int64_t by = weights.back().scale - w.scale;
    sum += by > 7 ? 0 : w.weight >> (kQuantum * static_cast<unsigned>(by));
    sums.push_back(sum * weights.size());
  }
  sums.back() = UINT64_MAX;
  return sums;
}

SystematicWalk::SystematicWalk(std::span<const std::uint64_t> sums, std::uint64_t total, std::uint32_t uniform,
                               std::span<const std::uint64_t> written, std::uint64_t scale_known)
    : sums_(sums),
      written_(written),
      total_(total),
      now_(scale_known + 1),
      walks_from_(written.back() + 4),
      left_(sums.size()) {
  __extension__ using Wide = unsigned __int128;
  threshold_ = static_cast<std::uint64_t>((Wide{total} * uniform) >> 24);
}

/// Whether a row is read in this cycle: it is written, and the queue has room for it.
bool SystematicWalk::reads() const {
  if (2 * read_ >= sums_.size() || read_ - walked_ == kRows) return false;
  return now_ > written_[std::min(2 * read_ + 1, sums_.size() - 1)];
}

/// The walk's cycle: an entry of parents, if the row has any; how many.
bool SystematicWalk::walk(Entry& entry, std::size_t& children) {
  if (now_ < walks_from_ || left_ == 0 || rows_.empty() || rows_.front() > now_ || parents_.size() == kParents)
    return false;
  const std::size_t even = 2 * walked_;
  const auto below = [&](std::size_t i, std::uint64_t more) { return sum(i) > threshold_ + more * total_; };
  children = !below(even + 1, 0) ? 0 : below(even + 1, 1) && left_ > 1 ? 2 : 1;
  const auto chosen = [&](std::uint64_t more) {
    return static_cast<std::uint32_t>(below(even, more) ? even : even + 1);
  };
  entry = {chosen(0), chosen(1), children == 2};
  return true;
}

bool SystematicWalk::cycle(bool ready, std::uint32_t& parent) {
  const bool read = reads();
  Entry entry{};
  std::size_t children = 0;
  const bool walks = walk(entry, children);
  const bool taken = ready && !parents_.empty();
  if (taken) {
    const Entry& head = parents_.front();
    parent = second_ ? head.second : head.first;
    second_ = head.pair && !second_;
    if (!second_) parents_.pop_front();
  }
  if (walks) {
    const bool stays = children == 2 && sum(2 * walked_ + 1) > threshold_ + 2 * total_;
    if (children > 0) parents_.push_back(entry);
    threshold_ += children * total_;
    left_ -= children;
    if (!stays) {
      rows_.pop_front();
      ++walked_;
    }
  }
  if (read) {
    rows_.push_back(now_ + 8);
    ++read_;
  }
  ++now_;
  return taken;
}

}  // namespace mote::hardware

#include "mote/hardware/filters/residual.hpp"

namespace mote::hardware {
namespace {

constexpr std::uint64_t kFirstRead = 2;  ///< cycles from writing the last weight to reading the first

}  // namespace

ResidualWalk::ResidualWalk(const Weighed& weighed, const Offspring& offspring, std::uint32_t uniform,
                           unsigned product_latency)
    : ends_(offspring.ends(weighed.weights, weighed.total, uniform)),
      now_(weighed.written.back() + kFirstRead + factor_wait(product_latency)),
      latency_(8 + product_latency) {}

bool ResidualWalk::cycle(bool ready, std::vector<std::uint32_t>& parents) {
  const bool taken = ready && shows();
  const bool reads = read_ < ends_.size() && room_ > 0;
  std::size_t freed = 0;
  if (taken) {
    parents.push_back(parents_.front());
    if (++shown_ == children(parents_.front())) {
      parents_.pop_front();
      shown_ = 0;
      ++freed;
    }
  }
  if (!flying_.empty() && flying_.front() == now_) {
    flying_.pop_front();
    if (children(arrived_) > 0)
      parents_.push_back(static_cast<std::uint32_t>(arrived_));
    else
      ++freed;
    ++arrived_;
  }
  if (reads) {
    flying_.push_back(now_ + latency_);
    ++read_;
    --room_;
  }
  room_ += freed;
  ++now_;
  return taken;
}

}  // namespace mote::hardware

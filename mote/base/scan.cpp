#include "mote/base/scan.hpp"

#include <algorithm>

namespace mote {
namespace {

constexpr std::size_t kRun = 1024;

}  // namespace

WeightScan::WeightScan(std::span<const double> weights) : weights_(weights) {
  base_.reserve(weights.size() / kRun + 2);
  base_.push_back(0);
  double carry = 0;
  for (std::size_t start = 0; start < weights.size(); start += kRun) {
    double run = 0;
    for (const double w : weights.subspan(start, std::min(kRun, weights.size() - start))) run += w;
    const double before = base_.back();
    const double step = run - carry;
    base_.push_back(before + step);
    carry = (base_.back() - before) - step;
  }
}

std::size_t WeightScan::find(double target) const {
  // The last block whose base is <= target; rounding may leave the target past that block's end, so look on.
  const auto above = std::upper_bound(base_.begin(), base_.end() - 1, target);
  auto block = static_cast<std::size_t>(above - base_.begin()) - 1;
  std::size_t last = weights_.size();
  for (; block + 1 < base_.size(); ++block) {
    double run = 0;
    const std::size_t stop = std::min((block + 1) * kRun, weights_.size());
    for (std::size_t i = block * kRun; i < stop; ++i) {
      if (weights_[i] <= 0) continue;
      run += weights_[i];
      last = i;
      if (base_[block] + run > target) return i;
    }
  }
  while (last == weights_.size() || weights_[last] <= 0) --last;
  return last;
}

std::size_t WeightScan::Walk::find(double target) {
  const auto weights = scan_->weights_;
  while (through_ <= target && at_ < weights.size()) {
    if (at_ % kRun == 0) run_ = 0;
    const double w = weights[at_];
    if (w > 0) {
      run_ += w;
      found_ = at_;
      through_ = scan_->base_[at_ / kRun] + run_;
    }
    ++at_;
  }
  return found_;
}

}  // namespace mote

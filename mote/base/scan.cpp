#include "mote/base/scan.hpp"

#include <algorithm>
#include <bit>

namespace mote {
namespace {

constexpr std::size_t kRun = 1024;
constexpr std::size_t kCell = 16;

}  // namespace

WeightScan::WeightScan(std::span<const double> weights) : weights_(weights) {
  base_.reserve(weights.size() / kRun + 2);
  runs_.reserve(weights.size() / kCell + 1);
  base_.push_back(0);
  double carry = 0;
  for (std::size_t start = 0; start < weights.size(); start += kRun) {
    double run = 0;
    for (std::size_t i = start; i < std::min(start + kRun, weights.size()); ++i) {
      if (i % kCell == 0) runs_.push_back(run);
      run += weights[i];
    }
    const double before = base_.back();
    const double step = run - carry;
    base_.push_back(before + step);
    carry = (base_.back() - before) - step;
  }
}

double WeightScan::before_cell(std::size_t cell) const { return base_[cell * kCell / kRun] + runs_[cell]; }

std::size_t WeightScan::find(double target) const {
  // the last cell whose prefix is <= target, then on from there; rounding may leave the target past that cell's end
  std::size_t cell = 0;
  for (std::size_t step = std::bit_floor(runs_.size()); step > 0; step /= 2)
    if (cell + step < runs_.size() && before_cell(cell + step) <= target) cell += step;
  double run = 0;
  for (std::size_t i = cell * kCell; i < weights_.size(); ++i) {
    if (i % kCell == 0) run = runs_[i / kCell];
    if (weights_[i] <= 0) continue;
    run += weights_[i];
    if (base_[i / kRun] + run > target) return i;
  }
  std::size_t last = weights_.size() - 1;
  while (weights_[last] <= 0) --last;
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

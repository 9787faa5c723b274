#pragma once
/// Cumulative sums of weights that stay right for 2^24 particles and more.

#include <cstddef>
#include <span>
#include <vector>

namespace mote {

/// The cumulative sums of a weight vector: block sums by compensated addition, then a running sum inside each block.
///
///   through(i) = sum_{j <= i} w_j
///
/// Every engine forms a prefix by the same two additions, so shares of blocks give the same bits. A prefix is wrong by
/// at most 1024 roundings of its block and one of the total: at N = 2^24 below 1e-5 of a mean weight (a running float
/// sum misplaces whole percents of a block's offspring). See docs/decisions/0003-weight-scans.md.
///
/// shape   weights: (N,), N >= 1, >= 0, finite, not all zero; they must outlive the scan
/// cost    O(N) once; memory N / 2 bytes
class WeightScan {
 public:
  explicit WeightScan(std::span<const double> weights);

  double total() const { return base_.back(); }
  std::span<const double> weights() const { return weights_; }

  /// The smallest i with through(i) > target and w_i > 0: inversion of the cumulative sum.
  ///
  /// shape   0 <= target < total(); a target at or past the total (by rounding) gives the last positive weight
  /// cost    O(log N)
  std::size_t find(double target) const;

  /// A reader of the cumulative sum for targets that never decrease; a whole pass costs O(N + targets).
  class Walk {
   public:
    explicit Walk(const WeightScan& scan) : scan_(&scan) {}
    std::size_t find(double target);

   private:
    const WeightScan* scan_;
    std::size_t at_ = 0;     // next weight to add
    double run_ = 0;         // sum of this block's weights before at_
    std::size_t found_ = 0;  // last positive weight passed
    double through_ = 0;     // cumulative sum through found_
  };

 private:
  std::span<const double> weights_;
  double before_cell(std::size_t cell) const;

  std::vector<double> base_;  // base_[b]: sum of the weights before block b; the last entry is the total
  std::vector<double> runs_;  // runs_[c]: sum of the weights of its block before cell c of sixteen
};

}  // namespace mote

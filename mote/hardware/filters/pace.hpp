#pragma once
/// When things happen on a filter circuit whose streams never wait: the clock of the golden models.

#include <algorithm>
#include <cstdint>

namespace mote::hardware {

/// Cycles since start_i, which is cycle 0 with the first observation on the stream.
class Pace {
 public:
  /// A step may begin once the one before is through with the model, and the estimate of the one before that has left.
  void begin() {
    begun_ = std::max(free_, left_before_ + 1);
    ++steps_;
  }
  std::uint64_t begun() const { return begun_; }
  /// The model is free from this cycle on.
  void free_from(std::uint64_t cycle) { free_ = cycle; }
  /// The sums of a step stand from this cycle on; its estimate leaves `division` cycles after they are taken.
  void sums_stand(std::uint64_t cycle, std::uint64_t division) {
    const std::uint64_t taken = steps_ == 1 ? cycle : std::max(cycle, left_ + 1);
    left_before_ = left_;
    left_ = taken + division;
  }
  /// The cycle in which the last estimate leaves.
  std::uint64_t left() const { return left_; }

 private:
  std::uint64_t steps_ = 0, begun_ = 0, free_ = 1, left_before_ = 0, left_ = 0;
};

}  // namespace mote::hardware

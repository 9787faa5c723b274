#pragma once
/// Samples of a recorded proposal: an auxiliary-variable filter in double that keeps its calls.

#include <cstdint>
#include <vector>

#include "mote/engine/recording.hpp"
#include "mote/graph/record.hpp"
#include "mote/hardware/datapath/samples.hpp"

namespace mote {

/// A filter over pairs (x, parent) of a recording with a proposal: every so-many-th pair's inputs of the move and of
/// the weight.
///
///   x ~ g(. | x^k, y),   w = p(y | x) p(x | x^k) / g(x | x^k, y),   parents by systematic resampling
///
/// shape   one pair in `stride` is kept, `most` of them; steps without a whole row are left out
/// cost    O(vertices) a particle and step
/// source  IMH-OPT (23)
class PairSampling {
 public:
  using Calls = std::vector<hardware::Samples::Call>;

  PairSampling(const graph::Recorded& recorded, std::size_t stride, std::size_t most)
      : recorded_(&recorded), stride_(stride), most_(most) {}

  void filter(const Recording& recording, std::size_t particles, std::uint64_t seed);

  const Calls& moves() const { return moves_; }
  const Calls& weighings() const { return weighings_; }

 private:
  using State = std::vector<double>;
  struct Pair {
    State x;
    double log_weight;
  };
  template <class Draw>
  State prior(Draw& draw) const;
  template <class Draw>
  Pair proposed(const State& before, const Row<double>& row, const std::vector<double>& schedule, Draw& draw);

  const graph::Recorded* recorded_;
  std::size_t stride_, most_, count_ = 0;
  Calls moves_, weighings_;
};

}  // namespace mote

#pragma once
/// Weights: the resamplers of an item on given weights.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// What a resampler did on the weights of one level, as the comparisons' repeats saw it.
struct Tradeoff {
  std::string run;
  double ess;
  double error, ns;  ///< mean error, median time
};

/// The resamplers of one item. Repeat r has its own weights, the same for all runs, which take turns.
class Weights {
 public:
  /// error   Refusal (kBadData) naming file:line for options that a plan does not have
  explicit Weights(const Item& item);

  /// What a comparison asks of a repeat of one of its runs.
  double figure(const Comparison& comparison, std::uint64_t repeat, std::size_t side);
  /// What was seen, by level and run.
  std::vector<Tradeoff> tradeoffs() const;

 private:
  struct Bench {
    std::string run;
    Scheme scheme;
  };
  using Level = std::pair<double, std::uint64_t>;  // of ESS, repeat

  const std::vector<Resampled>& resamplings(double ess, std::uint64_t repeat);

  WeightSource source_;
  std::vector<Bench> benches_;
  std::map<Level, std::vector<Resampled>> resamplings_;  // by run
};

}  // namespace mote::reproduce

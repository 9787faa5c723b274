#pragma once
/// How a filter fares in fixed-point arithmetic: a model's ranges and word lengths by simulation.

#include <functional>

#include "mote/app/catalogue/scene.hpp"
#include "mote/graph/words.hpp"
#include "mote/hardware/datapath/samples.hpp"

namespace mote {

/// What a study simulates.
struct WordStudyDesign {
  std::size_t particles = 500;
  Step steps = 50;
  std::size_t recordings = 20;
  std::uint64_t seed = 1;
  double margin = 0.25;  ///< by which ranges are wider than what was seen
  graph::WordSearch search;
};

/// A bootstrap filter's errors in an arithmetic: RMSE to the truth by state, over recordings of one design.
///
/// SISR, systematic at every step, weights in double; each recording has a seed of its own, the same in every
/// arithmetic.
class WordStudy {
 public:
  /// `first` is the number of its first recording: studies of other numbers are independent.
  WordStudy(const CatalogueModel& model, const WordStudyDesign& design, std::size_t first = 0);

  const graph::Recorded& recorded() const { return recorded_; }
  /// Ranges, from the double filter's particles.
  graph::Ranges ranges() const;
  /// The calls of the model's functions by the double filter, from which a circuit's words are chosen.
  hardware::Samples samples() const;
  /// The error in these formats over the double filter's: that of the state for which it is largest.
  double error_ratio(const graph::FixedPoint& point) const;

 private:
  template <class A>
  std::vector<double> errors(const std::shared_ptr<A>& arithmetic) const;

  WordStudyDesign design_;
  std::size_t first_;
  graph::Recorded recorded_;
  std::vector<Scene> scenes_;
  std::vector<graph::Interval> seen_;
  std::vector<double> double_errors_;
};

}  // namespace mote

#pragma once
/// How a filter fares in fixed-point arithmetic: a model's ranges and word lengths by simulation.

#include <functional>
#include <string>

#include "mote/app/catalogue/scene.hpp"
#include "mote/graph/words.hpp"
#include "mote/hardware/datapath/samples.hpp"

namespace mote {

/// Whether recordings can be drawn: a model given as text need not say how what it observes comes about.
bool can_be_drawn(const CatalogueModel& model);

/// What a study simulates, and what it is given.
struct WordStudyDesign {
  std::size_t particles = 200;
  Step steps = 50;
  std::size_t recordings = 10;
  std::uint64_t seed = 1;
  std::string where = {};          ///< who asks for it, for refusals
  std::string proposal = "prior";  ///< whose particles circuits' words are chosen by
  std::vector<Recording> given{};  ///< recordings beside those that the model draws; their truth is not known
  double margin = 0.25;            ///< by which ranges are wider than what was seen
  graph::WordSearch search;
};

/// A bootstrap filter's error in an arithmetic, over recordings of one design.
///
///   error ratio = sqrt(1 + sum d^2 / sum e^2),   e = the double filter's mean less the truth, d = the other's mean
///   less the double filter's
///
/// d counts as independent of e, since an arithmetic that brings these recordings nearer to the truth does so by
/// chance. SISR, systematic at every step; each recording has a seed of its own. The filter in an arithmetic has the
/// draws and the ancestors of the double filter, so that what differs is the arithmetic: filters that select by
/// themselves part where rounding first makes another ancestor, and then differ by chance.
class WordStudy {
 public:
  /// `first` is the number of its first recording: studies of other numbers are independent. A model that cannot be
  /// drawn from (a text without laws) is studied on the recordings given, where there are any.
  ///
  /// error   Refusal (kWrongUse): it cannot be drawn from, and none are given
  WordStudy(const CatalogueModel& model, const WordStudyDesign& design, std::size_t first = 0);

  const graph::Recorded& recorded() const { return recorded_; }
  /// Ranges, from the double filter's particles.
  graph::Ranges ranges() const;
  /// The calls of the model's functions by the double filter, from which a circuit's words are chosen; with a proposal
  /// those of the auxiliary-variable filter.
  hardware::Samples samples() const;
  /// The error ratio of these formats: that of the state for which it is largest.
  double error_ratio(const graph::FixedPoint& point) const;

 private:
  /// Sums of squares by state: e^2 and d^2.
  struct Squares {
    std::vector<double> errors, differences;
  };
  std::size_t particles_of(const Scene& scene) const;
  std::size_t calls() const;
  template <class A>
  Squares squares(const std::shared_ptr<A>& arithmetic) const;

  WordStudyDesign design_;
  std::size_t first_;
  graph::Recorded recorded_;
  std::vector<Scene> scenes_;
  std::vector<graph::Interval> seen_;
};

}  // namespace mote

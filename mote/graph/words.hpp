#pragma once
/// Word lengths: ranges of every vertex by analysis and simulation, and the smallest formats that keep a filter's
/// error.

#include <functional>
#include <vector>

#include "mote/graph/fixed.hpp"
#include "mote/graph/record.hpp"

namespace mote::graph {

/// The numbers that draws can be: normal ones are cut off at 8.3 standard deviations, a uniform one is below 1.
inline constexpr double kFurthestNormal = 8.3;

/// What is known of the range of every vertex.
struct Ranges {
  std::vector<Interval> analysed;  ///< by interval analysis from the inputs' ranges
  std::vector<Interval> seen;      ///< in a simulation; low above high where it was not computed
  std::vector<Interval> kept;      ///< what formats are to hold: seen, widened, within analysed
};

/// Ranges of a recording's vertices.
///
///   kept = [low - m w, high + m w] and the analysis of the inputs' kept ranges,   w = max(|low|, |high|)
///
/// shape   seen: (graph.size(),); margin m >= 0
/// cost    O(size)
Ranges ranges(const Recorded& recorded, const std::vector<Interval>& seen, double margin = 0.25);

/// What a search for word lengths is told.
struct WordSearch {
  double budget = 0.01;    ///< the error may grow by this part of the double filter's
  int most_fraction = 24;  ///< where it begins
  int most_bits = 40;      ///< of a word; beyond, it saturates
  Rounding rounding = Rounding::kNearest;
};

/// Formats and what they cost in accuracy.
struct Words {
  FixedPoint point;
  double ratio = 0;  ///< error in these formats over the double filter's
  bool within_budget = false;
  std::size_t trials = 0;  ///< filter runs of the search
};

/// The smallest formats that a search finds whose error stays within the budget.
///
/// First the smallest fraction that all vertices can share, by bisection; then, from the widest vertex to the
/// narrowest, as many bits less as each can do without while the others stay. Integer bits are those of the range.
///
/// shape   outputs: what formats are wanted for; error_ratio(point): error over the double filter's
/// error   not within the budget if the largest fraction is not
/// cost    some trials a vertex
Words search_words(const Graph& graph, std::span<const Id> outputs, const Ranges& ranges,
                   const std::function<double(const FixedPoint&)>& error_ratio, const WordSearch& search);

/// Bits of all words that outputs depend on.
std::size_t total_bits(const Graph& graph, std::span<const Id> outputs, const FixedPoint& point);

}  // namespace mote::graph

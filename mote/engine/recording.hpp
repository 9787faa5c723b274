#pragma once
/// Data as a filter sees it: rows grouped by step, and the truth to score against.

#include <map>
#include <string>
#include <vector>

#include "mote/model/model.hpp"

namespace mote {

/// The rows of one step; a row without any seen observation says nothing.
struct ObservedStep {
  Step t;
  std::vector<Row<double>> rows;  ///< rows with at least one observation seen
};

/// A recording: its steps in increasing t, gaps allowed, the first at any t >= 1.
struct Recording {
  std::vector<Column> observations;  ///< the observation columns
  std::vector<ObservedStep> steps;
};

/// True states by time; NaN where a state is not known.
struct Truth {
  std::vector<bool> known;                     ///< by state: whether the truth names it
  std::map<Step, std::vector<double>> states;  ///< (D,) each
};

}  // namespace mote

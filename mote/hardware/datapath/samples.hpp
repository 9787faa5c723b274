#pragma once
/// What a filter's particles were: the inputs of a recorded model's functions, from which ranges and precisions come.

#include <vector>

#include "mote/graph/interval.hpp"
#include "mote/graph/record.hpp"

namespace mote::hardware {

/// A function of a recorded model.
enum class Part { kInitial, kNext, kWeigh };

/// Inputs of a model's functions as a filter in double called them.
struct Samples {
  /// The inputs of one call, by vertex: (graph.size(),), numbers elsewhere are of no meaning.
  using Call = std::vector<double>;

  std::vector<Call> initial, next, weigh;
  std::vector<double> errors;  ///< by state: root mean square error of the filter's mean
};

}  // namespace mote::hardware

#pragma once
/// The laboratory: simulates an item's recording, runs its filters, computes what is compared.

#include <map>

#include "mote/app/commands/job.hpp"
#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// A comparison with its result.
struct Result {
  Comparison asked;
  double ours;
  std::optional<double> ratio;  ///< ours / paper, where the paper prints a number
  bool holds;
};

/// The runs of one item on its own recording, and the results of its comparisons.
struct Outcome {
  std::vector<Quantity> states;
  Truth truth;
  std::vector<std::pair<std::string, RunRecord>> records;  ///< by run
  std::vector<Result> results;
};

/// Regenerates an item. Repeats use filter seeds and recording seeds counted up from the item's; runs of one repeat
/// share both.
///
/// error   Refusal naming the item's file for options, models and states that do not exist
Outcome regenerate(const Item& item);

}  // namespace mote::reproduce

#pragma once
/// What a comparison leaves: a table to read, CSV and JSON to compute with, a page.

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/compare/figures.hpp"
#include "mote/report/page.hpp"

namespace mote::compare {

/// A study with its figures, ready to be shown.
struct Outcome {
  Design design;
  std::vector<std::vector<std::vector<Measured>>> runs;
  std::vector<std::vector<Figures>> figures;
  std::optional<double> lost_beyond;
  std::string source;   ///< "10 recordings of 100 steps, seeds 1 to 10", or the data's file
  std::string command;  ///< makes it again
};

// All of these take one comparison or several, the same contenders on different models.
// shape   outcomes: (models,), at least one

/// What was compared in a line, then the figures in aligned columns, then what lost runs mean.
std::string comparison_table(std::span<const Outcome> outcomes);

/// One row for each model, contender and number of particles, all figures with their intervals.
std::string comparison_csv(std::span<const Outcome> outcomes);

/// The design, the figures and every run; null stands for a number that is infinite or undefined. An object, or an
/// array of them for several models.
nlohmann::json comparison_json(std::span<const Outcome> outcomes);

/// One figure for each model, error against wall-clock in logarithms with a curve over N for each contender, and its
/// table.
report::Page comparison_page(std::span<const Outcome> outcomes);

}  // namespace mote::compare

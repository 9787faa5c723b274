#pragma once
/// What a comparison leaves: a table to read, CSV and JSON to compute with, a page.

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

/// What was compared in a line, then the figures in aligned columns, then what lost runs mean.
std::string comparison_table(const Outcome& outcome);

/// One row for each contender and number of particles, all figures with their intervals.
std::string comparison_csv(const Outcome& outcome);

/// The design, the figures and every run; null stands for a number that is infinite or undefined.
nlohmann::json comparison_json(const Outcome& outcome);

/// One figure, error against wall-clock in logarithms with a curve over N for each contender, and the table.
report::Page comparison_page(const Outcome& outcome);

}  // namespace mote::compare

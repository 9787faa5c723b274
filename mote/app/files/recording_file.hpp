#pragma once
/// Recordings and truths from CSV tables.

#include <string>
#include <vector>

#include "mote/app/files/table.hpp"
#include "mote/engine/recording.hpp"

namespace mote {

/// Rows of a table as a model's columns ask for them, grouped by step.
///
/// error   Refusal (kBadData): a missing observation column, a bad value, t decreasing, a gap of more than ten million
/// steps,
///         an input missing where the row is observed
Recording recording_from(const Table& table, const std::vector<Column>& columns, const std::string& model);

/// True states from a table with column t and any of the states.
///
/// error   Refusal (kBadData): none of the states, a bad value, t not increasing
Truth truth_from(const Table& table, const std::vector<Quantity>& states);

/// Columns of a table that nobody reads.
std::vector<std::string> unused_columns(const Table& table, const std::vector<std::string>& read);

}  // namespace mote

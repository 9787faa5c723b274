#pragma once
/// CSV with a header: the only tabular input. LF or CRLF, a byte-order mark, and blank lines are accepted.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

/// A table as read: fields are views into its text.
struct Table {
  struct Line {
    std::size_t number;  ///< in the file, from 1
    std::vector<std::string_view> fields;
  };
  std::string path;
  std::shared_ptr<const std::string> text;  ///< held apart, so that the fields stay where they are when a table moves
  std::size_t header_line = 1;
  std::vector<std::string> header;
  std::vector<Line> lines;

  std::optional<std::size_t> column(const std::string& name) const;
  /// "file:line" of a line.
  std::string where(const Line& line) const;
};

/// Splits a CSV text: every line as many fields as the header.
///
/// error   Refusal (kBadData): empty, no rows, a field count that differs, a column named twice
Table parse_table(std::string path, std::string text);

/// Reads and splits a CSV file.
Table read_table(const std::string& path);

/// A time: an integer from 1 to 2147483646.
int time_field(const Table& table, const Table::Line& line);

/// A finite number, or NaN for an empty field or `nan`.
double number_field(const Table& table, const Table::Line& line, std::size_t column);

}  // namespace mote

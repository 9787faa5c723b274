#include "mote/app/files/table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

constexpr long long kLastTime = 2147483646;

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields = parts_of(line, ',');
  for (std::string_view& field : fields)
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
  return fields;
}

void check_header(const Table& table) {
  for (std::size_t i = 0; i < table.header.size(); ++i)
    if (std::find(table.header.begin(), table.header.begin() + static_cast<std::ptrdiff_t>(i), table.header[i]) !=
        table.header.begin() + static_cast<std::ptrdiff_t>(i))
      throw Refusal(ExitCode::kBadData,
                    {fmt::format("{}:{}", table.path, table.header_line), "header", "every column once",
                     fmt::format("{} twice", in_quotes(table.header[i])), "Rename one of them."});
  if (table.header.front() != "t")
    throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", table.path, table.header_line), "first column", "\"t\"",
                                       in_quotes(table.header.front()),
                                       table.header.front().find_first_of(";\t") == std::string::npos
                                           ? "A data file starts with a header line whose first column is t."
                                           : "Separate the columns by commas."});
}

}  // namespace

std::optional<std::size_t> Table::column(const std::string& name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

std::string Table::where(const Line& line) const { return fmt::format("{}:{}", path, line.number); }

Table parse_table(std::string path, std::string text) {
  Table table;
  table.path = std::move(path);
  table.text = std::make_shared<const std::string>(std::move(text));
  std::string_view rest = *table.text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  bool have_header = false;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.empty()) continue;
    auto fields = fields_of(line);
    if (!have_header) {
      have_header = true;
      table.header_line = number;
      table.header.assign(fields.begin(), fields.end());
      check_header(table);
    } else if (fields.size() != table.header.size()) {
      throw Refusal(ExitCode::kBadData,
                    {fmt::format("{}:{}", table.path, number), "",
                     fmt::format("{} fields as in the header", table.header.size()), std::to_string(fields.size()),
                     fields.size() < table.header.size()
                         ? "The line may be cut off; write an empty field for a missed observation."
                         : "Write numbers with a point, not a comma."});
    } else {
      table.lines.push_back({number, std::move(fields)});
    }
  }
  if (!have_header)
    throw Refusal(ExitCode::kBadData, {table.path, "", "a header line and rows of data", "an empty file",
                                       "Start it with t,NAMES OF COLUMNS."});
  if (table.lines.empty())
    throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", table.path, table.header_line), "",
                                       "rows of data after the header", "none", "Write a row for every step."});
  return table;
}

Table read_table(const std::string& path) { return parse_table(path, read_text(path)); }

int time_field(const Table& table, const Table::Line& line) {
  const auto t = integer_in(line.fields.front());
  if (!t || *t < 1 || *t > kLastTime)
    throw Refusal(ExitCode::kBadData,
                  {table.where(line), "column \"t\"", fmt::format("an integer from 1 to {}", kLastTime),
                   in_quotes(line.fields.front()), "Number the steps from 1."});
  return static_cast<int>(*t);
}

double number_field(const Table& table, const Table::Line& line, std::size_t column) {
  const std::string_view field = line.fields[column];
  if (field.empty()) return std::nan("");
  const auto value = number_in(field);
  if (!value || std::isinf(*value))
    throw Refusal(ExitCode::kBadData,
                  {table.where(line), fmt::format("column \"{}\"", table.header[column]),
                   "a finite number or an empty field", in_quotes(field), "Write nan for a missed observation."});
  return *value;
}

}  // namespace mote

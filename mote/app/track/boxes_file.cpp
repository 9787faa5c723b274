#include "mote/app/track/boxes_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using vision::Box;

constexpr Box kNoBox{kNaN, kNaN, kNaN, kNaN};

Refusal bad_line(const std::string& path, std::size_t line, const std::string& expected, std::string_view got) {
  return {ExitCode::kBadData,
          {fmt::format("{}:{}", path, line), "", expected, in_quotes(got), "Write one box a line."}};
}

/// The four numbers of a line, separated by commas, blanks or tabs.
std::array<double, 4> four_numbers(const std::string& path, std::size_t line, std::string_view given) {
  std::string text(given);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\t' || c == '\r' || c == ';'; }, ' ');
  std::array<double, 4> numbers{};
  std::size_t count = 0;
  for (std::string_view rest = trimmed(text); !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    std::string word(rest.substr(0, end));
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto value = number_in(word);
    if (!value || count == 4) throw bad_line(path, line, "four numbers", given);
    numbers[count++] = *value;
    rest = trimmed(rest.substr(end));
  }
  if (count != 4) throw bad_line(path, line, "four numbers", given);
  return numbers;
}

Box as_otb(const std::array<double, 4>& n) { return {n[0] - 1, n[1] - 1, n[2], n[3]}; }
Box as_tld(const std::array<double, 4>& n) { return {n[0], n[1], n[2] - n[0], n[3] - n[1]}; }

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines = parts_of(text, '\n');
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

/// Where the columns frame, x, y, w, h stand in a header.
std::array<std::size_t, 5> columns_of(const std::string& path, std::string_view header) {
  const std::array<std::string_view, 5> names{"frame", "x", "y", "w", "h"};
  const auto fields = parts_of(header, ',');
  std::array<std::size_t, 5> columns{};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto found = std::find(fields.begin(), fields.end(), names[k]);
    if (found == fields.end())
      throw Refusal(ExitCode::kBadData,
                    {path + ":1", "", "the columns frame,x,y,w,h", in_quotes(header), "Name them in the first line."});
    columns[k] = static_cast<std::size_t>(found - fields.begin());
  }
  return columns;
}

std::vector<Box> by_frame(const std::string& path, const std::vector<std::string_view>& lines) {
  constexpr double kMostFrames = 1e7;
  const auto columns = columns_of(path, lines.front());
  std::vector<Box> boxes;
  for (std::size_t line = 2; line <= lines.size(); ++line) {
    const auto fields = parts_of(lines[line - 1], ',');
    std::array<double, 5> values{};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto value = columns[k] < fields.size() ? number_in(fields[columns[k]]) : std::nullopt;
      if (!value) throw bad_line(path, line, "numbers in frame,x,y,w,h", lines[line - 1]);
      values[k] = *value;
    }
    if (!(values[0] >= 1 && values[0] <= kMostFrames && values[0] == std::floor(values[0])))
      throw bad_line(path, line, "a frame number from 1", lines[line - 1]);
    const auto frame = static_cast<std::size_t>(values[0]);
    if (boxes.size() < frame) boxes.resize(frame, kNoBox);
    boxes[frame - 1] = {values[1], values[2], values[3], values[4]};
  }
  return boxes;
}

}  // namespace

std::string boxes_header() { return "frame,x,y,w,h,score,lost,centre_x,centre_y,log_w,log_h,angle,skew\n"; }

std::string boxes_line(std::size_t frame, const vision::Track& track) {
  using namespace vision;
  std::string line = fmt::format("{}", frame);
  for (const double value : {track.box.x, track.box.y, track.box.w, track.box.h, track.score})
    line += "," + exact(value);
  line += track.lost ? ",1" : ",0";
  for (const Component d : {kX, kY, kLogW, kLogH, kAngle, kSkew}) line += "," + exact(track.pose[d]);
  return line + "\n";
}

std::vector<Box> read_truth(const std::string& path, BoxFormat format, const Box* init) {
  const std::string text = read_text(path);
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty())
    throw Refusal(ExitCode::kBadData,
                  {path, "", "a box a line", "an empty file", "Name the file with the true boxes."});
  const bool headed = !lines.front().empty() && std::isalpha(static_cast<unsigned char>(lines.front().front())) != 0 &&
                      lines.front().find("rame") != std::string::npos;
  if (format == BoxFormat::kBoxes || (format == BoxFormat::kAuto && headed)) return by_frame(path, lines);
  std::vector<std::array<double, 4>> rows;
  for (std::size_t k = 0; k < lines.size(); ++k) rows.push_back(four_numbers(path, k + 1, lines[k]));
  if (format == BoxFormat::kAuto)
    format = init != nullptr && vision::overlap(as_tld(rows[0]), *init) > vision::overlap(as_otb(rows[0]), *init)
                 ? BoxFormat::kTld
                 : BoxFormat::kOtb;
  std::vector<Box> boxes;
  for (const auto& row : rows) boxes.push_back(format == BoxFormat::kTld ? as_tld(row) : as_otb(row));
  return boxes;
}

}  // namespace mote

#include "mote/report/page.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "mote/report/chart_json.hpp"
#include "mote/report/text.hpp"

namespace mote::report {
namespace {

// The browser itself refuses whatever the page would load: all it needs is in it.
constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; )"
                                   R"(script-src 'unsafe-inline'; img-src data:">
<meta name="generator" content="mote {version}">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
<header>
<h1>{title}</h1>
)";

constexpr std::string_view kNoPlots =
    "The plots are not shown: this mote was built without them. "
    "Build it with npm installed and the option MOTE_REPORT_PAGE on.";

std::string list_items(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += fmt::format("<li>{}</li>\n", escaped(text));
  return out;
}

std::string section(std::string_view id, std::string_view heading, std::string_view content) {
  return fmt::format("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}</section>\n", id, heading,
                     content);
}

std::string facts_part(const std::vector<Fact>& facts) {
  if (facts.empty()) return {};
  std::string list;
  for (const Fact& fact : facts)
    list += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(fact.name), escaped(fact.value));
  return section("facts", "Facts", fmt::format("<dl class=\"facts\">\n{}</dl>\n", list));
}

std::string pictures_part(const std::vector<Picture>& pictures) {
  if (pictures.empty()) return {};
  std::string figures;
  for (const Picture& picture : pictures)
    figures += fmt::format(
        "<figure class=\"picture\"><figcaption>{0}</figcaption><img alt=\"{0}\" "
        "src=\"data:image/{1};base64,{2}\"></figure>\n",
        escaped(picture.title), picture.bytes.starts_with("\xFF\xD8") ? "jpeg" : "png", base64(picture.bytes));
  return section("pictures", "Pictures", figures);
}

std::string charts_part(const std::vector<Chart>& charts) {
  if (charts.empty() || !plots_built_in()) return {};
  std::string figures =
      "<noscript><p class=\"error\">The charts are drawn by a script in this file; allow it to run.</p></noscript>\n";
  for (const Chart& chart : charts)
    figures += fmt::format("<figure data-chart=\"{0}\"><figcaption>{0}</figcaption></figure>\n", escaped(chart.title));
  return section("charts", "Charts", figures);
}

void require_cells(const Table& table, const std::vector<std::string>& row) {
  if (row.size() == table.columns.size()) return;
  throw std::invalid_argument(
      fmt::format("report page: table \"{}\": expected {} cells in every row, one per column, got {}. Write an empty "
                  "cell where there is no value.",
                  table.title, table.columns.size(), row.size()));
}

bool is_number(std::string_view cell) {
  double value = 0;
  const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return read.ec == std::errc() && read.ptr == cell.data() + cell.size();
}

// Columns of numbers stand right-aligned.
std::string cell_class(const Table& table, std::size_t column) {
  const auto fits = [&](const auto& row) { return row[column].empty() || is_number(row[column]); };
  return !table.rows.empty() && std::all_of(table.rows.begin(), table.rows.end(), fits) ? " class=\"number\"" : "";
}

std::string table_part(const Table& table) {
  for (const auto& row : table.rows) require_cells(table, row);
  std::vector<std::string> classes;
  std::string head, body;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    classes.push_back(cell_class(table, i));
    head += fmt::format("<th scope=\"col\"{}>{}</th>", classes[i], escaped(table.columns[i]));
  }
  for (const auto& row : table.rows) {
    body += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) body += fmt::format("<td{}>{}</td>", classes[i], escaped(row[i]));
    body += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"table\" role=\"region\" tabindex=\"0\" aria-label=\"{0}\"><table><caption>{0}</caption>\n"
      "<thead><tr>{1}</tr></thead>\n<tbody>\n{2}</tbody></table></div>\n",
      escaped(table.title), head, body);
}

std::string tables_part(const std::vector<Table>& tables) {
  std::string all;
  for (const Table& table : tables) all += table_part(table);
  return all.empty() ? all : section("tables", "Tables", all);
}

std::string notes_part(const Page& page) {
  std::vector<std::string> notes = page.notes;
  if (!page.charts.empty() && !plots_built_in()) notes.emplace_back(kNoPlots);
  if (notes.empty()) return {};
  return section("notes", "Notes", fmt::format("<ul class=\"notes\">\n{}</ul>\n", list_items(notes)));
}

// Options are kept from being broken after their hyphens.
std::string command_part(const std::string& command) {
  if (command.empty()) return {};
  std::string words;
  for (std::size_t at = 0; at <= command.size();) {
    const std::size_t end = std::min(command.find(' ', at), command.size());
    const std::string_view text = std::string_view(command).substr(at, end - at);
    words += text.starts_with('-') ? fmt::format(" <span>{}</span>", escaped(text)) : ' ' + escaped(text);
    at = end + 1;
  }
  return section("command", "Command", fmt::format("<pre><code>{}</code></pre>\n", words.substr(1)));
}

// The guard comes first: it must be listening when the rest runs.
std::string scripts(const std::vector<Chart>& charts) {
  std::string data = chart_json(charts);  // also without plots, for its refusals
  if (!plots_built_in()) return {};
  return fmt::format(
      "<script>\n{}</script>\n<script type=\"application/json\" "
      "id=\"charts-data\">{}</script>\n<script>\n{}</script>\n",
      guard_text(), data, script_text());
}

}  // namespace

bool plots_built_in() { return !script_text().empty(); }

std::string html(const Page& page) {
  std::string out = fmt::format(kHead, fmt::arg("version", MOTE_VERSION), fmt::arg("title", escaped(page.title)),
                                fmt::arg("style", style_text()));
  if (!page.summary.empty()) out += fmt::format("<p class=\"summary\">{}</p>\n", escaped(page.summary));
  out += "</header>\n<main>\n";
  out += facts_part(page.facts) + pictures_part(page.pictures) + charts_part(page.charts) + tables_part(page.tables) +
         notes_part(page) + command_part(page.command);
  out += fmt::format("</main>\n<footer>mote {}</footer>\n", MOTE_VERSION);
  return out + scripts(page.charts) + "</body>\n</html>\n";
}

}  // namespace mote::report

#pragma once
// The contract of the report room: a Page is data (facts, charts, tables, notes), html() is the one way to show it.
// A Page knows nothing of filters; whoever has a result fills one in. Every member but the name has a default: write
// Chart{.title = "Level", .x_label = "t", .series = {...}}.

#include <string>
#include <vector>

namespace mote::report {

/// One named sequence of points. NaN or infinite values are gaps: a line breaks there, a point is left out.
/// A series named "truth" is drawn apart from the others (dashed, in the colour of the text).
struct Series {
  /// kSteps: the value holds until the next x; kMarkedLine: a line whose points are seen
  enum class Mark { kLine, kPoints, kSteps, kMarkedLine };
  std::string name;
  Mark mark = Mark::kLine;
  std::vector<double> x = {}, y = {};
  std::vector<std::string> labels = {};  ///< what each point is, shown where it is pointed at; none, or one for each
};

/// The region low(x) <= y <= high(x), for example an estimate +- 2 sd; NaN is a gap.
/// A band whose name starts with the name of a series of its chart takes that series' colour.
struct Band {
  std::string name;
  std::vector<double> x = {}, low = {}, high = {};
};

/// Bars from begin to end along x, each in a row: who was at work when. All in one colour.
struct Bars {
  std::string name;
  std::vector<double> begin = {}, end = {}, row = {};
};

/// One plot. Charts with the same x_label zoom together along x. Titles name charts and should differ within a page.
struct Chart {
  std::string title, x_label = {}, y_label = {};
  std::vector<Band> bands = {};
  std::vector<Series> series = {};
  bool log_x = false, log_y = false;  ///< a logarithmic axis shows positive values only; the page counts the rest
  bool equal_axes = false;            ///< one unit is as long along x as along y: tracks in the plane
  std::vector<Bars> bars = {};
  std::vector<std::string> rows = {};  ///< names of y = 0, 1, ..., counted from the top: what bars are rows of
};

struct Fact {
  std::string name, value;
};

struct Table {
  std::string title;
  std::vector<std::string> columns = {};
  std::vector<std::vector<std::string>> rows = {};
};

/// A picture, as the bytes of a PNG or JPEG file.
struct Picture {
  std::string title, bytes;
};

/// Everything a report shows, in the order it is shown; empty parts are left out.
struct Page {
  std::string title, summary = {};
  std::string command = {};  ///< the command line that made the result
  std::vector<Fact> facts = {};
  std::vector<Picture> pictures = {};
  std::vector<Chart> charts = {};
  std::vector<Table> tables = {};
  std::vector<std::string> notes = {};
};

/// The page as one self-contained HTML file: it loads nothing, so it works from a disk, in a mail and in ten years.
///
/// Any text may stand in any name, markup included; bytes that are no UTF-8 are replaced. Numbers keep 7 significant
/// digits of a series' range. Without plots_built_in() the charts are replaced by a note that says so.
///
/// error   std::invalid_argument if x and y (low, high; end, row) of a series (band; bars) differ in length, or if a
/// row of a table has
///         not one cell per column
/// cost    O(characters + points); about 0.6 MB for the plots' code and 10 bytes per number
std::string html(const Page& page);

/// True if this library was built with its plots (MOTE_REPORT_PAGE=ON, and npm was found).
bool plots_built_in();

}  // namespace mote::report

#include "mote/graph/words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mote::graph {
namespace {

bool was_seen(const Interval& seen) { return seen.low <= seen.high; }

Interval widened(const Interval& seen, double margin) {
  const double more = margin * std::max(std::abs(seen.low), std::abs(seen.high));
  return {seen.low - more, seen.high + more};
}

/// What an input can be, from what it was.
Interval input_range(const Vertex& v, const Interval& seen, double margin) {
  if (v.role == Role::kNormal || v.role == Role::kPriorNormal) return {-kFurthestNormal, kFurthestNormal};
  if (v.role == Role::kUniform || v.role == Role::kPriorUniform) return {0, 1};
  return was_seen(seen) ? widened(seen, margin) : Interval{};
}

/// A constant in as few bits as say the same at that fraction.
Format format_of_constant(double value, int fraction, int most) {
  Format format = format_for({value, value}, fraction, most);
  const int start = format.fraction;
  const std::int64_t raw = to_fixed(value, format, Rounding::kNearest);
  while (format.width() > 1 && format.fraction > -format.integer + 1 &&
         raw % (std::int64_t{2} << (start - format.fraction)) == 0)
    --format.fraction;
  return format;
}

class Search {
 public:
  Search(const Graph& graph, std::span<const Id> outputs, const Ranges& ranges,
         const std::function<double(const FixedPoint&)>& error_ratio, const WordSearch& search)
      : graph_(graph),
        used_(reached(graph, outputs)),
        ranges_(ranges),
        error_ratio_(error_ratio),
        search_(search),
        fraction_(graph.size(), search.most_fraction) {}

  Words found() {
    words_.within_budget = passes();
    if (words_.within_budget) {
      share_a_fraction();
      shorten_each();
    }
    words_.point = point();
    words_.ratio = error_ratio_(words_.point);
    return std::move(words_);
  }

 private:
  FixedPoint point() const {
    FixedPoint point;
    point.rounding = search_.rounding;
    for (Id id = 0; id < graph_.size(); ++id)
      point.formats.push_back(graph_.is_constant(id)
                                  ? format_of_constant(graph_[id].value, fraction_[id], search_.most_bits)
                                  : format_for(ranges_.kept[id], fraction_[id], search_.most_bits));
    return point;
  }
  bool passes() {
    ++words_.trials;
    return error_ratio_(point()) <= 1 + search_.budget;
  }

  /// The smallest fraction that does for all.
  void share_a_fraction() {
    int fails = -1;
    int does = search_.most_fraction;
    while (does - fails > 1) {
      const int middle = (does + fails) / 2;
      std::fill(fraction_.begin(), fraction_.end(), middle);
      (passes() ? does : fails) = middle;
    }
    std::fill(fraction_.begin(), fraction_.end(), does);
  }

  /// Takes bits off each vertex, in halving strides.
  void shorten_each() {
    const FixedPoint start = point();
    for (Id id = 0; id < graph_.size(); ++id) fraction_[id] = std::min(fraction_[id], start.formats[id].fraction);
    std::vector<Id> order;
    for (Id id = 0; id < graph_.size(); ++id)
      if (used_[id]) order.push_back(id);
    std::stable_sort(order.begin(), order.end(),
                     [&](Id a, Id b) { return start.formats[a].width() > start.formats[b].width(); });
    for (const Id id : order)
      for (const int stride : {4, 2, 1})
        while (start.formats[id].width() - (start.formats[id].fraction - fraction_[id]) > stride &&
               passes_with(id, fraction_[id] - stride)) {
        }
  }
  /// Whether that fraction does for a vertex; keeps it if so.
  bool passes_with(Id id, int fraction) {
    const int before = std::exchange(fraction_[id], fraction);
    const bool does = passes();
    if (!does) fraction_[id] = before;
    return does;
  }

  const Graph& graph_;
  std::vector<bool> used_;
  const Ranges& ranges_;
  const std::function<double(const FixedPoint&)>& error_ratio_;
  WordSearch search_;
  std::vector<int> fraction_;  ///< bits after the point, by vertex
  Words words_;
};

}  // namespace

Ranges ranges(const Recorded& recorded, const std::vector<Interval>& seen, double margin) {
  const Graph& graph = recorded.graph;
  Ranges all{{}, seen, {}};
  all.analysed = intervals(graph, [&](const Vertex& v) {
    return input_range(v, seen[static_cast<std::size_t>(&v - graph.vertices().data())], margin);
  });
  for (Id id = 0; id < graph.size(); ++id)
    all.kept.push_back(was_seen(seen[id]) && !graph.is_constant(id)
                           ? intersection(widened(seen[id], margin), all.analysed[id])
                           : all.analysed[id]);
  return all;
}

Words search_words(const Graph& graph, std::span<const Id> outputs, const Ranges& ranges,
                   const std::function<double(const FixedPoint&)>& error_ratio, const WordSearch& search) {
  return Search(graph, outputs, ranges, error_ratio, search).found();
}

std::size_t total_bits(const Graph& graph, std::span<const Id> outputs, const FixedPoint& point) {
  const std::vector<bool> used = reached(graph, outputs);
  std::size_t sum = 0;
  for (Id id = 0; id < graph.size(); ++id)
    if (used[id]) sum += static_cast<std::size_t>(point.formats[id].width());
  return sum;
}

}  // namespace mote::graph

#pragma once
/// Frontiers: what is best when several figures count, and what is best within limits.

#include <cstddef>
#include <vector>

namespace mote::design {

/// The figures of a design – an error, a time, an area –, each the better the less it is.
using Point = std::vector<double>;

/// Whether a is at most as large as b in every figure, and smaller in one.
bool dominates(const Point& a, const Point& b);

/// The places of the points that no other dominates, in their order. Equal points stay together.
///
/// shape   points: all of one length, no NaN
/// cost    O(n log n + n f), f points of the frontier
std::vector<std::size_t> frontier(const std::vector<Point>& points);

/// A limit on one figure.
struct Limit {
  std::size_t figure = 0;
  double most = 0;  ///< > 0
};

/// The largest factor by which a point exceeds a limit; 1 where it keeps them all.
double excess(const Point& point, const std::vector<Limit>& limits);

/// What is best within limits.
struct Choice {
  std::size_t place = 0;
  bool feasible = false;            ///< it keeps all limits; else none does
  std::vector<std::size_t> broken;  ///< the limits that it exceeds
};

/// The point that keeps all limits and has the least of a figure; where none does the nearest: the one that exceeds
/// them by the least factor, then has the least of the figure. Ties go to the less in the order of the figures, then to
/// the first.
///
/// shape   points: at least one, no NaN
Choice best_within(const std::vector<Point>& points, const std::vector<Limit>& limits, std::size_t goal);

}  // namespace mote::design

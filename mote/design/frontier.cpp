#include "mote/design/frontier.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace mote::design {
bool dominates(const Point& a, const Point& b) {
  return a != b && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return x <= y; });
}

std::vector<std::size_t> frontier(const std::vector<Point>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // whoever dominates a point comes before it
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<std::size_t> found;
  for (const std::size_t k : order)
    if (std::none_of(found.begin(), found.end(), [&](std::size_t f) { return dominates(points[f], points[k]); }))
      found.push_back(k);
  std::sort(found.begin(), found.end());
  return found;
}

double excess(const Point& point, const std::vector<Limit>& limits) {
  double factor = 1;
  for (const Limit& limit : limits) factor = std::max(factor, point[limit.figure] / limit.most);
  return factor;
}

Choice best_within(const std::vector<Point>& points, const std::vector<Limit>& limits, std::size_t goal) {
  const auto key = [&](const Point& point) { return std::tuple(excess(point, limits), point[goal], point); };
  const auto best =
      std::min_element(points.begin(), points.end(), [&](const Point& a, const Point& b) { return key(a) < key(b); });
  Choice choice{static_cast<std::size_t>(best - points.begin()), true, {}};
  for (std::size_t k = 0; k < limits.size(); ++k)
    if ((*best)[limits[k].figure] > limits[k].most) choice.broken.push_back(k);
  choice.feasible = choice.broken.empty();
  return choice;
}

}  // namespace mote::design

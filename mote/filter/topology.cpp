#include "mote/filter/topology.hpp"

#include <bit>

namespace mote {
namespace {

/// The largest divisor of n whose square is at most n.
std::size_t rows_of(std::size_t n) {
  std::size_t rows = 1;
  for (std::size_t r = 1; r * r <= n; ++r)
    if (n % r == 0) rows = r;
  return rows;
}

/// Group k on a ring of groups first, first + stride, ..., one before or after it.
std::size_t along(std::size_t first, std::size_t stride, std::size_t length, std::size_t k, bool forward) {
  const std::size_t place = (k - first) / stride;
  return first + stride * ((place + (forward ? 1 : length - 1)) % length);
}

std::vector<std::size_t> named(Topology topology, std::size_t groups, std::size_t k, std::size_t turn) {
  switch (topology) {
    case Topology::kRing:
      return {along(0, 1, groups, k, true)};
    case Topology::kBidirectional:
      return {along(0, 1, groups, k, true), along(0, 1, groups, k, false)};
    case Topology::kTorus: {
      const std::size_t rows = rows_of(groups);
      const std::size_t columns = std::max<std::size_t>(1, groups / rows);
      const std::size_t row = k - k % columns;
      const std::size_t column = k % columns;
      return {along(row, 1, columns, k, true), along(row, 1, columns, k, false), along(column, columns, rows, k, true),
              along(column, columns, rows, k, false)};
    }
    case Topology::kHypercube: {
      const std::size_t dimensions = static_cast<std::size_t>(std::bit_width(groups)) - 1;
      if (dimensions == 0) return {};
      return {k ^ (std::size_t{1} << (turn % dimensions))};
    }
  }
  return {};
}

}  // namespace

std::vector<std::size_t> neighbours(Topology topology, std::size_t groups, std::size_t k, std::size_t turn) {
  std::vector<std::size_t> all;
  for (const std::size_t other : named(topology, groups, k, turn))
    if (other != k && std::find(all.begin(), all.end(), other) == all.end()) all.push_back(other);
  return all;
}

std::size_t degree(Topology topology, std::size_t groups) { return neighbours(topology, groups, 0, 0).size(); }

}  // namespace mote

#include <vector>

#include "mote/base/log_weights.hpp"
#include "mote/filter/resample/schemes.hpp"

namespace mote {
namespace {

/// Vose's table: cell i yields i with probability keep[i], else other[i].
struct AliasTable {
  std::vector<double> keep;
  std::vector<std::uint32_t> other;
};

/// Vose 1991: pair each cell below the mean with one above it. O(N). Work lists share one array, low cells from the
/// left, high from the right.
AliasTable build(std::span<const double> weights) {
  const std::size_t n = weights.size();
  const double scale = static_cast<double>(n) / ordered_sum(n, [&](std::size_t i) { return weights[i]; });
  AliasTable table{std::vector<double>(n), std::vector<std::uint32_t>(n)};
  std::vector<std::uint32_t> work(n);
  std::size_t low = 0;
  std::size_t high = n;
  std::uint32_t heaviest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    table.keep[i] = weights[i] * scale;
    table.other[i] = static_cast<std::uint32_t>(i);
    if (weights[i] > weights[heaviest]) heaviest = static_cast<std::uint32_t>(i);
    work[table.keep[i] < 1 ? low++ : --high] = static_cast<std::uint32_t>(i);
  }
  while (low > 0 && high < n) {
    const std::uint32_t small = work[--low];
    const std::uint32_t large = work[high];
    table.other[small] = large;
    table.keep[large] = (table.keep[large] + table.keep[small]) - 1;
    if (table.keep[large] < 1) {
      ++high;
      work[low++] = large;
    }
  }
  // What is left holds 1 but for rounding; a cell of weight zero must never keep itself.
  for (; low > 0; --low) {
    const std::uint32_t cell = work[low - 1];
    table.keep[cell] = weights[cell] > 0 ? 1 : 0;
    if (weights[cell] <= 0) table.other[cell] = heaviest;
  }
  return table;
}

}  // namespace

void alias(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const AliasTable table = build(weights);
  draws.for_each(Purpose::kSelect, 0, ancestors.size(), [&](std::size_t j, auto& draw) {
    const std::size_t cell = draw.index(weights.size());
    ancestors[j] = draw.uniform() < table.keep[cell] ? static_cast<std::uint32_t>(cell) : table.other[cell];
  });
}

}  // namespace mote

#include "mote/hardware/datapath/tables.hpp"

#include "mote/base/refusal.hpp"

namespace mote::hardware {
namespace {

constexpr std::size_t kMostEntries = 1024;
/// A table of so many bits goes into a block of RAM.
constexpr std::size_t kBlockRamFrom = 8192;

std::optional<Piecewise> fitted(const std::function<double(double)>& function, const Format& x, const Format& y,
                                Fold fold, const FitGoal& goal) {
  try {
    return fit_piecewise(function, x, y, fold, 0, goal);
  } catch (const Refusal&) {
    return {};
  }
}

}  // namespace

int cost_of(const Piecewise& unit) {
  const PiecewiseShape& shape = unit.shape();
  const bool octaves = shape.regions() > 1;
  const std::size_t bits = unit.memory_bits();
  const int memory = bits < kBlockRamFrom ? static_cast<int>(bits / 40) : kLutsOfBlockRam;
  const int product = shape.multiplier == Multiplier::kDsp ? kLutsOfDsp : shape.delta_bits() * shape.y.width();
  return shape.x.width() + (octaves ? 4 * shape.u_bits() : 0) + 2 * shape.y.width() + memory + shape.degree * product;
}

std::optional<Piecewise> smallest_table(const std::function<double(double)>& function, const Format& x, const Format& y,
                                        const std::vector<Fold>& folds, Multiplier multiplier) {
  std::optional<Piecewise> best;
  for (const Fold fold : folds)
    for (const int degree : {1, 2}) {
      auto unit = fitted(function, x, y, fold, {1.0, degree, multiplier, kMostEntries});
      if (unit && (!best || cost_of(*unit) < cost_of(*best))) best = std::move(unit);
    }
  return best;
}

}  // namespace mote::hardware

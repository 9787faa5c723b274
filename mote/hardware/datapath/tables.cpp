#include "mote/hardware/datapath/tables.hpp"

#include "mote/base/refusal.hpp"

namespace mote::hardware {
namespace {

constexpr std::size_t kMostEntries = 1024;
/// Bits of a table that a look-up table holds, and a block of RAM.
constexpr std::size_t kBitsOfLut = 64, kBitsOfBlock = 18432;

std::optional<Piecewise> fitted(const std::function<double(double)>& function, const Format& x, const Format& y,
                                Fold fold, const FitGoal& goal) {
  try {
    return fit_piecewise(function, x, y, fold, 0, goal);
  } catch (const Refusal&) {
    return {};
  }
}

int cost_of_memory(std::size_t bits) {
  const std::size_t luts = (bits + kBitsOfLut - 1) / kBitsOfLut;
  const std::size_t blocks = (bits + kBitsOfBlock - 1) / kBitsOfBlock * kLutsOfBlockRam;
  return static_cast<int>(bits < Lookup::kBlockFrom ? luts : blocks);
}

/// No unit of polynomials costs less: a line of a segment, by a DSP block.
int least_of_piecewise(const Format& x, const Format& y) {
  return x.width() + 2 * y.width() + kLutsOfDsp + 6 * kLutsOfClock;
}

int cost_of(const Lookup& unit) { return cost_of_memory(unit.memory_bits()); }

int cost_of(const Piecewise& unit) {
  const PiecewiseShape& shape = unit.shape();
  const bool octaves = shape.regions() > 1;
  const int product = shape.multiplier == Multiplier::kDsp ? kLutsOfDsp : shape.delta_bits() * shape.y.width();
  return shape.x.width() + (octaves ? 4 * shape.u_bits() : 0) + 2 * shape.y.width() +
         cost_of_memory(unit.memory_bits()) + shape.degree * product;
}

}  // namespace

int FunctionTable::cost() const {
  return std::visit([](const auto& unit) { return cost_of(unit) + kLutsOfClock * unit.circuit().latency; }, unit_);
}

std::optional<FunctionTable> cheapest_table(const std::function<double(double)>& function, const Format& x,
                                            const Format& y, const std::vector<Fold>& folds, Multiplier multiplier) {
  std::optional<FunctionTable> best;
  const auto consider = [&](FunctionTable unit) {
    if (!best || unit.cost() < best->cost()) best = std::move(unit);
  };
  if (x.width() <= Lookup::kMostBits) consider(FunctionTable(Lookup(function, x, y)));
  if (best && best->cost() <= least_of_piecewise(x, y)) return best;
  for (const Fold fold : folds)
    for (const int degree : {1, 2})
      if (auto unit = fitted(function, x, y, fold, {1.0, degree, multiplier, kMostEntries}))
        consider(FunctionTable(std::move(*unit)));
  return best;
}

}  // namespace mote::hardware

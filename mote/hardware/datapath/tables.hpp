#pragma once
/// The cheapest table for a function of one number.

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "mote/hardware/lookup.hpp"
#include "mote/hardware/piecewise.hpp"

namespace mote::hardware {

/// What hardware costs, in look-up tables: a DSP block and a block of RAM are taken for so many, and a clock of latency
/// for the registers of what has to wait for it.
inline constexpr int kLutsOfDsp = 80, kLutsOfBlockRam = 150, kLutsOfClock = 12;

/// A function of one number: all its values, or polynomials on segments.
class FunctionTable {
 public:
  explicit FunctionTable(Lookup unit) : unit_(std::move(unit)) {}
  explicit FunctionTable(Piecewise unit) : unit_(std::move(unit)) {}

  Circuit circuit() const {
    return std::visit([](const auto& unit) { return unit.circuit(); }, unit_);
  }
  void compute(Columns in, Results out) const {
    std::visit([&](const auto& unit) { unit.compute(in, out); }, unit_);
  }
  /// The table of all values, if it is one.
  const Lookup* lookup() const { return std::get_if<Lookup>(&unit_); }
  /// The polynomials, if it is those.
  const Piecewise* piecewise() const { return std::get_if<Piecewise>(&unit_); }
  /// The same with a table of all values in look-up tables of the device; polynomials' are small.
  FunctionTable in_logic() const { return lookup() != nullptr ? FunctionTable(lookup()->in_logic()) : *this; }
  /// About what it takes.
  int cost() const;

 private:
  std::variant<Lookup, Piecewise> unit_;
};

/// The cheapest of a look-up of all values and of lines and parabolas with these folds that keep to a step of y with
/// 1024 segments at most; nothing if there is none.
///
/// cost    milliseconds to a second
std::optional<FunctionTable> cheapest_table(const std::function<double(double)>& function, const Format& x,
                                            const Format& y, const std::vector<Fold>& folds, Multiplier multiplier);

}  // namespace mote::hardware

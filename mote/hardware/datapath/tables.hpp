#pragma once
/// The cheapest table for a function of one number.

#include <optional>
#include <vector>

#include "mote/hardware/piecewise.hpp"

namespace mote::hardware {

/// What hardware costs, in look-up tables: a DSP block and a block of RAM are taken for so many.
inline constexpr int kLutsOfDsp = 80, kLutsOfBlockRam = 150;

/// About what a unit takes.
int cost_of(const Piecewise& unit);

/// The cheapest of lines and parabolas with these folds that keeps to a step of y; nothing if none does with 1024
/// segments.
///
/// cost    milliseconds to a second
std::optional<Piecewise> smallest_table(const std::function<double(double)>& function, const Format& x, const Format& y,
                                        const std::vector<Fold>& folds, Multiplier multiplier);

}  // namespace mote::hardware

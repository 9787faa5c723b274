#pragma once
/// Quantities on the command line: a number with its unit, "1ms", "100 mW".

#include <span>
#include <string>
#include <string_view>

#include "mote/app/commands/command.hpp"

namespace mote {

/// A unit in the unit that the program computes in.
struct Unit {
  std::string_view name;
  double size;
};

/// Of time, in seconds; of power, in milliwatts.
inline constexpr Unit kTimes[] = {{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"s", 1}};
inline constexpr Unit kPowers[] = {{"mW", 1}, {"uW", 1e-3}, {"W", 1e3}};

/// The option's quantity; `example` is what a refusal proposes.
///
/// error   Refusal (kWrongUse) for no number above 0 with one of the units
double quantity_from(const Arguments& arguments, const std::string& option, std::span<const Unit> units,
                     const std::string& example);

/// A time, seconds, in the unit that leaves a number of 1 to 1000: "1.25 ms".
std::string in_units(double seconds);

}  // namespace mote

#pragma once
/// How often the bits of a circuit change in a simulation: what its power is estimated by.

#include <cstdint>
#include <string>

namespace mote::hardware {

/// What a share of changing bits is taken for when nothing was simulated.
inline constexpr double kUsualActivity = 0.125;

/// Shares of bits that change in a clock.
struct Activity {
  double fabric = kUsualActivity;    ///< of all signals but those of the multipliers
  double products = kUsualActivity;  ///< of the multipliers' operands and products
  bool measured = false;
};

/// The shares in what Verilator wrote of a run of so many cycles: a count of changes for every bit of every instance.
///
/// shape   points: the text of its coverage file, of a circuit compiled with --coverage-toggle
Activity activity_of(const std::string& points, std::uint64_t cycles);

}  // namespace mote::hardware

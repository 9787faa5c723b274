#pragma once
/// What MIXED prints of its circuits, and the currents at which ours are looked at.

#include <array>
#include <vector>

#include "mote/analog/behaviour.hpp"
#include "mote/base/numbers.hpp"

namespace mote {

/// A circuit in Tables II and III.
struct Printed {
  analog::Function function;
  double least_error, most_error;        ///< percent of the maximum
  double least_power_uw, most_power_uw;  ///< at 3 V
  std::vector<double> ia_na;             ///< the least and the most are printed, those between are ours
};

const std::vector<Printed>& table2();
const Printed& printed_for(analog::Function function);

inline constexpr double kDegree = kPi / 180;
inline constexpr std::array kSigmas_deg{0.29, 2.8};  ///< the tracker's sigma_r
inline constexpr double kTrueBearing_deg = 33.8;     ///< of Fig. 3

}  // namespace mote

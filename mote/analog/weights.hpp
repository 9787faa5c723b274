#pragma once
/// The weights of a bearings tracker as its two circuits make them (MIXED, Fig. 3).

#include <vector>

#include "mote/analog/behaviour.hpp"

namespace mote::analog {

/// Weights over the bearing of a particle, for one measured bearing; each curve 1 where its function is at its peak.
struct WeightCurve {
  double sigma_rad = 0;
  std::vector<double> bearing_rad = {};                      ///< of the particle
  std::vector<double> exact = {};                            ///< exp(-(z - theta)^2 / (2 sigma^2))
  std::vector<double> approximation = {};                    ///< by what the circuits compute ideally
  std::vector<double> analog = {};                           ///< by their behaviours
  double approximation_shift_rad = 0, analog_shift_rad = 0;  ///< of the mode, from z
};

/// The arctan's output, the measured bearing taken off, is the Gaussian's input: a mirror scales it by I_a(gaussian) /
/// (sigma I_a(arctan)), so that sigma is the Gaussian's I_a.
///
///   w(theta) = gaussian((z - arctan(tan theta)) / sigma)
///
/// shape   0 < sigma, z within (-pi/2, pi/2); theta from z - 4 sigma to z + 4 sigma, inside (-1.4, 1.4)
WeightCurve weight_curve(const Behaviour& arctan, const Behaviour& gaussian, double measured_rad, double sigma_rad);

}  // namespace mote::analog

#pragma once
/// Resamplers on given weights: how far the resampled set strays, and what a draw costs.

#include <cstdint>
#include <vector>

#include "mote/filter/resample/schemes.hpp"

namespace mote::reproduce {

/// What resamplers are tried on: [weights] of an item.
struct WeightSource {
  std::size_t particles = 1000;
  std::vector<double> ess;  ///< levels of ESS / N, each in (0, 1)
  std::uint64_t seed = 1;
};

/// Particles with weights of a stated effective sample size.
struct WeightedValues {
  std::vector<double> values, weights;  ///< (N,); weights sum to one
};

/// Particles of a filter in the small: values from the prior, in random order, weighted by a measurement of one.
///
///   x_i ~ N(0, 1),  w_i ~ exp(-b (x_i - 1)^2 / 2), b such that ESS = 1 / sum w_i^2 is `ess` N within 1e-6 of it
///
/// cost    O(N), 60 times
WeightedValues weighted_values(std::size_t particles, double ess, std::uint64_t seed);

/// What a scheme does with a set of weights.
struct Resampled {
  double error;  ///< mean square of the resampled set's mean minus the weighted one, in those of multinomial draws
  double ns;     ///< per draw
};

/// Resamples `draws` times and compares the means.
///
///   error = mean_l (sum_j x_{a_lj} / N - m)^2 / (sum_i w_i (x_i - m)^2 / N),   m = sum_i w_i x_i
///
/// The divisor is the exact variance under multinomial draws, so that scheme's error is 1 but for noise. A scheme's
/// bias (metropolis) is in its error.
///
/// shape   draws >= 1
/// unit    error: multinomial variances; ns: nanoseconds of the machine at hand, per ancestor drawn
/// cost    `draws` resamplings
Resampled resampled(const Scheme& scheme, const WeightedValues& set, std::size_t draws, std::uint64_t seed);

}  // namespace mote::reproduce

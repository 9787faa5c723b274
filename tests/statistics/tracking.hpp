#pragma once
/// MIXED's two tracking cases and IMH-HW's direction of arrival.

#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "tests/statistics/makers.hpp"

namespace mote::statistics {

/// MIXED: sigma_u = 0.001 and its initial state are the model's defaults; 24 steps bring the target past its closest
/// approach.
inline Bearings mixed_case(double sigma_r_degrees) {
  Bearings model;
  model.p.sigma_r = sigma_r_degrees * kPi / 180;
  return model;
}
inline Recording mixed_recording(double sigma_r_degrees) {
  return simulate(mixed_case(sigma_r_degrees), 24, 5).recording;
}

/// The largest distance over the steps between two traces, of component d.
inline double largest_distance(const Trace& a, const Trace& b, std::size_t d) {
  double largest = 0;
  for (std::size_t k = 0; k < a.means.size(); ++k) largest = std::max(largest, std::abs(a.means[k][d] - b.means[k][d]));
  return largest;
}

/// The mean trace of `runs` runs, and by step and component its standard error.
struct Averaged {
  Trace mean;
  std::vector<std::vector<double>> errors;
};
template <Model M>
Averaged averaged(const Maker& maker, const M& model, const Recording& recording, std::size_t particles,
                  std::size_t runs) {
  const std::size_t dimensions = model.states().size();
  std::vector<std::vector<Sample>> samples(recording.steps.size(), std::vector<Sample>(dimensions));
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const Trace got = trace(*maker.make(particles, seed), model.states(), recording);
    for (std::size_t k = 0; k < samples.size(); ++k)
      for (std::size_t d = 0; d < dimensions; ++d) samples[k][d].values.push_back(got.means[k][d]);
  }
  Averaged all;
  for (const auto& step : samples) {
    all.mean.means.emplace_back();
    all.errors.emplace_back();
    for (const Sample& sample : step) {
      all.mean.means.back().push_back(sample.mean());
      all.errors.back().push_back(sample.error());
    }
  }
  return all;
}

}  // namespace mote::statistics

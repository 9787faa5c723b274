#pragma once
/// Two exactly solvable models and recordings of them with everything a recording may have: missing steps and entries,
/// gaps, several rows.

#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"
#include "tests/statistics/support.hpp"

namespace mote::statistics {

inline constexpr Step kSteps = 10;

/// Step 4 is unobserved, step 6 is missing from the recording, step 8 has two rows.
inline Recording with_holes(Recording recording, Row<double> second) {
  recording.steps[3].rows.clear();
  recording.steps[7].rows.push_back(std::move(second));
  recording.steps.erase(recording.steps.begin() + 5);
  return recording;
}

/// A walk of unit variance seen in noise of unit variance; `noise_scale` multiplies its standard deviation, for twins.
inline LocalLevel local_level(double noise_scale = 1) { return {{1, noise_scale * noise_scale, 0, 4}}; }
inline Recording local_level_recording() {
  return with_holes(simulate(local_level(), kSteps, 1001).recording, Row<double>::of({1.5}));
}

/// A damped, driven plane with correlated noises.
inline LinearGaussian plane(double noise_scale = 1) {
  LinearGaussianParameters p;
  p.F = Eigen::Matrix2d{{0.9, 0.3}, {-0.2, 0.8}};
  p.Q = Eigen::Matrix2d{{0.5, 0.2}, {0.2, 0.4}};
  p.H = Eigen::Matrix2d{{1, 0}, {0.5, 1}};
  p.R = noise_scale * noise_scale * Eigen::Matrix2d{{1, 0.3}, {0.3, 0.8}};
  p.mean = Eigen::Vector2d(0.5, -0.5);
  p.covariance = Eigen::Matrix2d{{1, 0.2}, {0.2, 1}};
  return LinearGaussian(p);
}
/// As above; besides, the first entry is missing at steps 2 and 9, the second at step 5.
inline Recording plane_recording() {
  const auto simulated = simulate(plane(), kSteps, 1002, [](Step t, std::vector<Row<double>>& rows) {
    const auto drop = [&](std::size_t j) {
      rows[0].values[j] = kNaN;
      rows[0].present[j] = false;
    };
    if (t == 2 || t == 9) drop(0);
    if (t == 5) drop(1);
  });
  return with_holes(simulated.recording, Row<double>::of({0.3, -0.4}));
}

}  // namespace mote::statistics

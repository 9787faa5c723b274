#include "mote/vision/model.hpp"

#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

/// log density of the patch under the appearance, a mean per pixel.
double appearance_fit(const Sight& sight, const Pose& pose) {
  alignas(64) std::array<float, kPixels> patch;
  sample_patch(sight.window, affine_of(pose, sight.first), patch);
  normalise_patch(patch);
  if (sight.likelihood.by_distance) return -sight.appearance->mean_squared_distance(patch);
  return sight.appearance->mean_log_density(patch);
}

double squared(double x) { return x * x; }

}  // namespace

Likelihood likelihood_of(Fit fit) {
  Likelihood likelihood;
  if (fit == Fit::kFused) return likelihood;
  likelihood.by_distance = fit == Fit::kDistance;
  likelihood.appearance = 60;
  likelihood.place = likelihood.extent = 0;
  return likelihood;
}

double log_fit(const Sight& sight, const Pose& pose) {
  if (!is_sane(pose)) return -kInfinity;
  if (pose[kX] < 0 || pose[kY] < 0 || pose[kX] > sight.width || pose[kY] > sight.height) return -kInfinity;
  const Likelihood& by = sight.likelihood;
  const double shape = squared(pose[kLogW] - pose[kLogH]) / squared(by.aspect_sd) +
                       (squared(pose[kAngle]) + squared(pose[kSkew])) / squared(by.angle_sd);
  double fit = -0.5 * shape;
  if (by.appearance > 0) fit += by.appearance * appearance_fit(sight, pose);
  if (by.place > 0) fit += by.place * sight.place.at(pose[kX], pose[kY]);
  if (by.extent > 0) fit += by.extent * sight.extent.at(0.5 * (pose[kLogW] + pose[kLogH]) - sight.log_size);
  return fit;
}

Pose moved(const Sight& sight, const Pose& before, const std::array<double, kComponents>& noise) {
  const Motion& motion = sight.motion;
  const double side = std::sqrt(sight.first.w * sight.first.h) * std::exp(0.5 * (before[kLogW] + before[kLogH]));
  Pose pose = before;
  pose[kX] += before[kVx] + sight.drift_x + motion.place * side * noise[kX];
  pose[kY] += before[kVy] + sight.drift_y + motion.place * side * noise[kY];
  pose[kVx] = motion.damping * before[kVx] + motion.speed * side * noise[kVx];
  pose[kVy] = motion.damping * before[kVy] + motion.speed * side * noise[kVy];
  pose[kLogW] += motion.size * noise[kLogW] + motion.aspect * noise[kLogH];
  pose[kLogH] += motion.size * noise[kLogW] - motion.aspect * noise[kLogH];
  pose[kAngle] += motion.angle * noise[kAngle];
  pose[kSkew] += motion.skew * noise[kSkew];
  return pose;
}

std::vector<Quantity> VisualModel::states() const {
  return {{"x", "px"},   {"y", "px"},   {"vx", "px"},     {"vy", "px"},
          {"log_w", ""}, {"log_h", ""}, {"angle", "rad"}, {"skew", ""}};
}

std::vector<Column> VisualModel::columns() const { return {{.name = "frame", .unit = ""}}; }

}  // namespace mote::vision

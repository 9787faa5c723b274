#include "mote/vision/pose.hpp"

#include <algorithm>

namespace mote::vision {

double overlap(const Box& a, const Box& b) {
  const double w = std::min(a.x + a.w, b.x + b.w) - std::max(a.x, b.x);
  const double h = std::min(a.y + a.h, b.y + b.h) - std::max(a.y, b.y);
  const bool known = std::isfinite(a.x + a.y + a.w + a.h + b.x + b.y + b.w + b.h);
  if (!known || w <= 0 || h <= 0) return 0;
  const double common = w * h;
  return common / (a.area() + b.area() - common);
}

double centre_distance(const Box& a, const Box& b) {
  return std::hypot(a.centre_x() - b.centre_x(), a.centre_y() - b.centre_y());
}

Pose pose_of(const Box& box, const Size& first) {
  Pose pose{};
  pose[kX] = box.centre_x();
  pose[kY] = box.centre_y();
  pose[kLogW] = std::log(box.w / first.w);
  pose[kLogH] = std::log(box.h / first.h);
  return pose;
}

Box box_of(const Pose& pose, const Size& first) {
  const double w = first.w * std::exp(pose[kLogW]);
  const double h = first.h * std::exp(pose[kLogH]);
  return {pose[kX] - w / 2, pose[kY] - h / 2, w, h};
}

bool is_sane(const Pose& pose) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(pose.begin(), pose.end(), finite) && std::abs(pose[kLogW]) < 6.9 && std::abs(pose[kLogH]) < 6.9;
}

}  // namespace mote::vision
